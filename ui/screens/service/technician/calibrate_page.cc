// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calibration at the screen: the board and what is stored; then what the cameras see of it, what to show next
// and how much has been seen; then the verdict in millimetres.
#include <algorithm>
#include <cstdio>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

const char* words_of(const Words& tr, BoardAdvice advice) {
  switch (advice) {
    case BoardAdvice::ShowBoard:
      return tr("Show the whole board to both cameras");
    case BoardAdvice::LeftCameraMissesIt:
      return tr("The left camera does not see all of it");
    case BoardAdvice::RightCameraMissesIt:
      return tr("The right camera does not see all of it");
    case BoardAdvice::HoldStill:
      return tr("Hold it still");
    case BoardAdvice::TooBlurred:
      return tr("It is not sharp: more light, or another distance");
    case BoardAdvice::Closer:
      return tr("Closer");
    case BoardAdvice::Farther:
      return tr("Farther away");
    case BoardAdvice::Left:
      return tr("To the left of the picture");
    case BoardAdvice::Right:
      return tr("To the right of the picture");
    case BoardAdvice::Up:
      return tr("Higher");
    case BoardAdvice::Down:
      return tr("Lower");
    case BoardAdvice::TiltLeft:
      return tr("Its left edge nearer to the cameras");
    case BoardAdvice::TiltRight:
      return tr("Its right edge nearer to the cameras");
    case BoardAdvice::TiltForward:
      return tr("Its upper edge nearer to the cameras");
    case BoardAdvice::TiltBack:
      return tr("Its lower edge nearer to the cameras");
    case BoardAdvice::TurnClockwise:
      return tr("Turn it clockwise");
    case BoardAdvice::TurnCounterclockwise:
      return tr("Turn it counterclockwise");
    case BoardAdvice::AlreadyHave:
      return tr("This view is known: another one, please");
    case BoardAdvice::SwappedCameras:
      return tr("The cameras have changed places: swap them and begin again");
    case BoardAdvice::Done:
      break;
  }
  return tr("Enough has been seen");
}

const char* words_of(const Words& tr, BoardEnd end) {
  switch (end) {
    case BoardEnd::GoalReached:
      return tr("The goal is reached.");
    case BoardEnd::Plateau:
      return tr("More views would hardly improve it.");
    case BoardEnd::Full:
      return tr("As many views as are wanted.");
    case BoardEnd::NotYet:
      break;
  }
  return tr("It was ended early.");
}

// How much of the picture has been seen: the more corners in a part, the fuller its square. As large as the
// picture above it.
void coverage(TechnicianFrame& b, std::size_t side, float aspect) {
  const auto& seen = b.view.calibration.seen[side];
  Node frame = b.page.grown(b.page.box(Flow::Stack));
  frame.aspect = aspect;
  b.page.tree.open(frame);
  Node map = b.page.box(Flow::Column, 3);
  map.id = side == 0 ? "left coverage" : "right coverage";
  map.name = side == 0 ? b.tr("Seen by the left camera") : b.tr("Seen by the right camera");
  map.role = Role::Picture;
  b.page.tree.open(map);
  for (std::size_t row = 0; row < kCoverageCells; ++row) {
    Node line = b.page.grown(b.page.box(Flow::Row, 3));
    line.box.left_to_right = true;
    b.page.tree.open(line);
    for (std::size_t column = 0; column < kCoverageCells; ++column) {
      Node cell = b.page.grown(b.page.box(Flow::Column));
      const float share = std::min(1.0F, static_cast<float>(seen[row * kCoverageCells + column]) / 40);
      cell.box.fill =
          share > 0 ? b.page.palette.accent.with_alpha(0.45F + 0.55F * share) : b.page.palette.track;
      cell.box.radius = b.page.px(3);
      b.page.tree.leaf(cell);
    }
    b.page.tree.close();
  }
  b.page.tree.close();
  b.page.tree.close();
}

// The pictures above, what of each has been seen below.
void live_pictures(TechnicianFrame& b) {
  const auto pair = [&](const auto& one) {
    Node row = b.page.grown(b.page.box(Flow::Row, space::kS));
    row.box.left_to_right = true;
    b.page.tree.open(row);
    for (std::size_t side = 0; side < 2; ++side) one(side);
    b.page.tree.close();
  };
  Node column = b.page.grown(b.page.box(Flow::Column, space::kS), b.picture_share(1.6F));
  b.page.tree.open(column);
  pair([&](std::size_t side) {
    b.open_picture(side == 0 ? "left board" : "right board",
                   side == 0 ? b.tr("Left camera") : b.tr("Right camera"), b.view.calibration.pictures[side],
                   side == 0 ? PictureSlot::TechnicianLeft : PictureSlot::TechnicianRight);
    b.close_picture();
  });
  pair([&](std::size_t side) {
    const ImageView& seen = b.view.calibration.pictures[side].pixels;
    coverage(b, side,
             seen.empty() ? 1.0F : static_cast<float>(seen.width_px) / static_cast<float>(seen.height_px));
  });
  b.page.tree.close();
}

void bar(TechnicianFrame& b, std::string_view id, const char* label, float share) {
  b.page.tree.open(b.page.box(Flow::Column, 4, 0, 7));
  b.page.tree.leaf(b.page.text(label, 18, Weight::Medium, b.page.palette.ink));
  b.page.progress(id, share);
  b.page.tree.close();
}

void running(TechnicianFrame& b) {
  const TechnicianCalibration& c = b.view.calibration;
  Node said = b.page.text(words_of(b.tr, c.advice), type::kHeading, Weight::Bold, b.page.palette.link,
                          TextAlign::Centre);
  said.id = "advice";
  said.role = Role::Status;
  said.style.size_px = b.page.px(type::kHeading * (1 + (b.page.text_share - 1) * 0.5F));
  b.page.tree.leaf(said);
  b.page.tree.open(b.page.grown(b.page.box(b.page.portrait ? Flow::Column : Flow::Row, space::kM)));
  live_pictures(b);
  b.page.tree.open(b.page.grown(b.page.box(Flow::Column)));
  b.page.begin_panel("progress list");
  b.page.row("views", b.tr("Views taken"), b.page.number(c.views));
  b.page.row("error", b.tr("Predicted error"),
             c.error_mm > 0 ? b.page.number(static_cast<double>(c.error_mm), 3, "mm") : std::string_view("–"),
             c.error_mm > 0 && c.error_mm <= c.goal_mm ? Mood::Good : Mood::Plain);
  b.page.row("goal", b.tr("Goal"), b.page.number(static_cast<double>(c.goal_mm), 3, "mm"));
  if (c.disagreeing > 0)
    b.page.row("disagreeing", b.tr("Views that disagree"), b.page.number(c.disagreeing), Mood::Warn);
  const char* const names[] = {b.tr("Across"), b.tr("Up and down"), b.tr("Size"), b.tr("Tilt")};
  for (std::size_t i = 0; i < c.bars.size(); ++i) bar(b, b.id("bar", i), names[i], c.bars[i]);
  b.page.tree.close();
  b.page.tree.close();
  b.page.tree.close();
  const float grow = b.open_buttons();
  b.page.small_button("calibration cancel", b.tr("Cancel"), icon::kClose, ButtonLook::Quiet,
                      technician_action(TechnicianAct::CancelCalibration), grow);
  b.page.small_button("calibration finish", b.tr("Enough: work it out"), icon::kCheck, ButtonLook::Main,
                      technician_action(TechnicianAct::StopCalibration), grow);
  b.page.tree.close();
}

void verdict(TechnicianFrame& b) {
  const TechnicianCalibration& c = b.view.calibration;
  if (!c.ended) return;
  const bool good = c.verdict == TechnicianVerdict::Good, refused = c.verdict == TechnicianVerdict::Refuse;
  const Mood mood = good ? Mood::Good : refused ? Mood::Bad : Mood::Warn;
  const char* said = good      ? b.tr("Good")
                     : refused ? b.tr("Refused: it would measure wrongly")
                               : b.tr("Usable, with doubts");
  b.page.section(b.tr("The new calibration"));
  b.page.row("verdict", b.tr("Verdict"), said, mood);
  for (const std::string& reason : c.reasons) b.page.detail(reason);
  if (!c.reasons.empty()) b.page.rule();
  b.page.row("ended", words_of(b.tr, c.end), {});
  b.page.row("depth error", b.tr("Error of a face's distance"),
             b.page.number(static_cast<double>(c.depth_error_mm), 3, "mm"), mood);
  b.page.row("rms", b.tr("Disagreement with the board"),
             b.page.number(static_cast<double>(c.rms_px), 3, "px"));
  b.page.row("baseline", b.tr("Distance of the cameras"),
             b.page.number(static_cast<double>(c.baseline_mm), 2, "mm"));
  b.page.row("views used", b.tr("Views taken"), b.page.number(c.views));
  if (c.stored) b.page.row("stored", b.tr("Stored, and in use from now on"), {}, Mood::Good);
}

void history(TechnicianFrame& b) {
  const TechnicianCalibration& c = b.view.calibration;
  b.page.section(b.tr("Stored calibrations: touch one to use it"));
  if (c.history_count == 0) b.page.row("no history", b.tr("There is none yet"), {});
  for (std::size_t i = 0; i < c.history_count; ++i) {
    const TechnicianCalibrationRow& row = c.history[i];
    const std::string_view label =
        b.joined(b.page.number(row.revision), "\u00a0· ", b.page.date(row.made_at));
    const std::string_view value = row.active ? std::string_view(b.tr("in use"))
                                   : row.depth_error_mm > 0
                                       ? b.page.number(static_cast<double>(row.depth_error_mm), 3, "mm")
                                       : std::string_view("–");
    b.page.row(
        b.id("calibration", i), label, value, row.active ? Mood::Good : Mood::Plain,
        row.active ? Action{} : technician_action(TechnicianAct::Activate, static_cast<std::int32_t>(i)));
  }
  if (b.view.calibrated)
    b.page.row("calibration export", b.tr("Export to the stick"), {}, Mood::Plain,
               technician_action(TechnicianAct::ExportCalibration));
  b.page.row("calibration import", b.tr("Import from the stick"), {}, Mood::Plain,
             technician_action(TechnicianAct::ImportCalibration));
}

void board(TechnicianFrame& b) {
  const TechnicianCalibration& c = b.view.calibration;
  const auto stepper = [&](std::string_view id, const char* label, std::string_view value, TechnicianAct act,
                           std::int32_t step) {
    b.page.stepper(id, label, value, icon::kLess, technician_action(act, -step), icon::kMore,
                   technician_action(act, step));
  };
  b.page.section(b.tr("The board"));
  stepper("columns", b.tr("Inner corners across"), b.page.number(c.columns), TechnicianAct::Columns, 1);
  stepper("rows", b.tr("Inner corners down"), b.page.number(c.rows), TechnicianAct::Rows, 1);
  stepper("square", b.tr("Side of a square"), b.page.number(static_cast<double>(c.square_mm), 1, "mm"),
          TechnicianAct::Square, 5);
  b.page.row("charuco", b.tr("With markers (ChArUco)"), c.charuco ? b.tr("yes") : b.tr("no"), Mood::Plain,
             technician_action(TechnicianAct::Charuco));
}

void at_rest(TechnicianFrame& b) {
  const TechnicianCalibration& c = b.view.calibration;
  b.page.begin_list("calibration");
  verdict(b);
  board(b);
  history(b);
  b.page.tree.close();
  const float grow = b.open_buttons();
  const bool store =
      c.ended && !c.stored && c.verdict != TechnicianVerdict::Refuse && c.verdict != TechnicianVerdict::None;
  b.page.small_button("calibration begin", b.tr("Calibrate"), icon::kCamera,
                      store ? ButtonLook::Quiet : ButtonLook::Main,
                      technician_action(TechnicianAct::BeginCalibration), grow);
  if (store)
    b.page.small_button("calibration store", b.tr("Store and use it"), icon::kDisk, ButtonLook::Main,
                        technician_action(TechnicianAct::StoreCalibration), grow);
  b.page.tree.close();
}

}  // namespace

void technician_calibrate_page(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame b(page);
  if (!b.view.calibration.exported.empty())
    page.status("calibration exported",
                page.filled(b.tr("Recorded on the stick as {}. It can be pulled out."),
                            b.left_to_right(b.view.calibration.exported)),
                Mood::Good);
  b.problem(b.view.calibration.problem.empty() ? page.view.calibration_note : b.view.calibration.problem);
  if (b.view.calibration.running) running(b);
  else at_rest(b);
}

}  // namespace relievo::ui
