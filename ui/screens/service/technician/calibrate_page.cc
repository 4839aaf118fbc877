// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calibration at the screen: the board and what is stored; then what the cameras see of it, what to show next
// and how much has been seen; then the verdict in millimetres.
#include <algorithm>
#include <array>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

using pipeline::CalibrationVerdict, pipeline::LiveAdvice, pipeline::LiveEnd;

constexpr std::size_t kMostViews = 64;

// In the order of LiveAdvice.
constexpr std::array kAdviceWords{mark_tr("Show the whole board to both cameras"),
                                  mark_tr("The left camera does not see all of it"),
                                  mark_tr("The right camera does not see all of it"),
                                  mark_tr("Hold it still"),
                                  mark_tr("It is not sharp: more light, or another distance"),
                                  mark_tr("Closer"),
                                  mark_tr("Farther away"),
                                  mark_tr("To the left of the picture"),
                                  mark_tr("To the right of the picture"),
                                  mark_tr("Higher"),
                                  mark_tr("Lower"),
                                  mark_tr("Its left edge nearer to the cameras"),
                                  mark_tr("Its right edge nearer to the cameras"),
                                  mark_tr("Its upper edge nearer to the cameras"),
                                  mark_tr("Its lower edge nearer to the cameras"),
                                  mark_tr("Turn it clockwise"),
                                  mark_tr("Turn it counterclockwise"),
                                  mark_tr("This view is known: another one, please"),
                                  mark_tr("The cameras have changed places: swap them and begin again"),
                                  mark_tr("Enough has been seen")};
static_assert(kAdviceWords.size() == std::size_t(LiveAdvice::Done) + 1);

// In the order of LiveEnd. Who ended it by hand knows.
constexpr std::array kEndWords{"", mark_tr("The goal is reached."),
                               mark_tr("More views would hardly improve it."),
                               mark_tr("Enough has been seen")};
static_assert(kEndWords.size() == std::size_t(LiveEnd::Full) + 1);

// How much of the picture has been seen: the more corners in a part, the fuller its square. As large as the
// picture above it.
void coverage(TechnicianFrame& f, std::size_t side, float aspect) {
  const auto& seen = f.seen.calibration.seen[side];
  Node frame = f.grown(f.box(Flow::Stack));
  frame.aspect = aspect;
  const auto in_frame = f.tree.inside(frame);
  Node map = f.box(Flow::Column, 3);
  tell(map, Role::Picture, side == 0 ? "left coverage" : "right coverage",
       f.filled("{}: {}", {f.camera_name(side), f.tr("Views taken")}));
  const auto in_map = f.tree.inside(map);
  for (std::size_t row = 0; row < kCoverageCells; ++row) {
    const auto in_line = f.tree.inside(left_first(f.grown(f.box(Flow::Row, 3))));
    for (std::size_t column = 0; column < kCoverageCells; ++column) {
      const float share = std::min(1.0F, float(seen[row * kCoverageCells + column]) / 40);
      const Colour fill = share > 0 ? f.palette.accent.with_alpha(0.45F + 0.55F * share) : f.palette.track;
      f.tree.leaf(f.painted(f.grown(f.box(Flow::Column)), fill, 3));
    }
  }
}

// The pictures above, what of each has been seen below.
void live_pictures(TechnicianFrame& f) {
  const auto pair = [&](const auto& one) {
    const auto in_row = f.tree.inside(left_first(f.grown(f.box(Flow::Row, space::kS))));
    for (std::size_t side = 0; side < 2; ++side) one(side);
  };
  const auto in_column = f.tree.inside(f.grown(f.box(Flow::Column, space::kS), f.picture_share(1.6F)));
  pair([&](std::size_t side) {
    f.open_picture(side == 0 ? "left board" : "right board", f.camera_name(side),
                   f.seen.calibration.pictures[side], f.slot_of(side));
    f.tree.close();
  });
  pair([&](std::size_t side) { coverage(f, side, aspect_of(f.seen.calibration.pictures[side].pixels)); });
}

void bar(TechnicianFrame& f, std::string_view id, const char* label, float share) {
  const auto in_box = f.tree.inside(f.box(Flow::Column, 4, 0, 7));
  f.write(label, 18, Weight::Medium, f.palette.ink);
  f.progress(id, share);
}

void running(TechnicianFrame& f) {
  const TechnicianCalibration& c = f.seen.calibration;
  Node said = f.text(one_of(f.tr, kAdviceWords, c.advice), type::kHeading, Weight::Bold, f.palette.link,
                     TextAlign::Centre);
  said.style.size_px = f.px(type::kHeading * (1 + (f.text_share - 1) * 0.5F));
  f.put("advice", Role::Status, said);
  f.tree.open(f.grown(f.abreast_box(space::kM)));
  live_pictures(f);
  f.tree.open(f.grown(f.box(Flow::Column)));
  f.begin_panel("progress list");
  f.row("views", f.tr("Views taken"), f.number(c.views));
  f.row("error", f.tr("Predicted error"),
        c.error_mm > 0 ? f.number(c.error_mm, 3, "mm") : std::string_view("–"),
        c.error_mm > 0 && c.error_mm <= c.goal_mm ? Mood::Good : Mood::Plain);
  f.row("goal", f.tr("Goal"), f.number(c.goal_mm, 3, "mm"));
  if (c.disagreeing > 0)
    f.row("disagreeing", f.tr("Views that disagree"), f.number(c.disagreeing), Mood::Warn);
  const char* const names[] = {f.tr("Across"), f.tr("Up and down"), f.tr("Size"), f.tr("Tilt")};
  for (std::size_t i = 0; i < c.bars.size(); ++i) bar(f, f.id("bar", i), names[i], c.bars[i]);
  f.tree.close(3);
  const float grow = f.open_buttons();
  f.small_button("calibration cancel", f.tr("Stop"), icon::kClose, ButtonLook::Quiet,
                 TechnicianAct::CancelCalibration, grow);
  if (c.enough)
    f.small_button("calibration finish", f.tr("Done"), icon::kCheck, ButtonLook::Main,
                   TechnicianAct::StopCalibration, grow);
  f.tree.close();
}

// A view that stands out was held badly, or seen badly.
void views(TechnicianFrame& f) {
  const TechnicianCalibration& c = f.seen.calibration;
  std::array<std::string_view, kMostViews> names;
  const std::size_t count = std::min(names.size(), c.views_px.size());
  for (std::size_t i = 0; i < count; ++i) names[i] = f.number(i + 1);
  Plot plot;
  plot.id = "rms", plot.title = f.tr("Disagreement with the board");
  plot.figure = f.number(c.rms_px, 3, "px");
  plot.values = c.views_px.first(count), plot.names = {names.data(), count}, plot.unit = "px";
  f.plot(plot);
}

void verdict(TechnicianFrame& f) {
  const TechnicianCalibration& c = f.seen.calibration;
  if (!c.ended) return;
  const bool good = c.verdict == CalibrationVerdict::Pass, refused = c.verdict == CalibrationVerdict::Refuse;
  const Mood mood = good ? Mood::Good : refused ? Mood::Bad : Mood::Warn;
  const char* said = good      ? f.tr("Good")
                     : refused ? f.tr("Refused: it would measure wrongly")
                               : f.tr("Usable, with doubts");
  f.section(f.tr("Verdict"));
  f.row("verdict", said, {}, mood);
  for (const std::string& reason : c.reasons) f.detail(reason);
  if (!c.reasons.empty()) f.rule();
  // What was wrong with it is said above.
  if (c.end != LiveEnd::NotYet && !refused) f.row("ended", one_of(f.tr, kEndWords, c.end), {});
  f.row("depth error", f.tr("Predicted error"), f.number(c.depth_error_mm, 3, "mm"), mood);
  views(f);
  f.row("baseline", f.tr("Distance of the cameras"), f.number(c.baseline_mm, 2, "mm"));
  if (c.stored) f.row("stored", f.tr("It applies from now on."), {}, Mood::Good);
}

void history(TechnicianFrame& f) {
  const TechnicianCalibration& c = f.seen.calibration;
  f.section(f.tr("Stored calibrations: touch one to use it"));
  if (c.history_count == 0) f.row("no history", f.tr("There is none yet"), {});
  for (std::size_t i = 0; i < c.history_count; ++i) {
    const TechnicianCalibrationRow& row = c.history[i];
    const std::string_view label = f.left_to_right({f.number(row.revision), "\u00a0· ", f.date(row.made_at)});
    const bool known = row.depth_error_mm > 0;
    std::string_view value = known ? f.number(row.depth_error_mm, 3, "mm") : std::string_view("–");
    if (row.active) value = known ? f.filled("{} · {}", {f.tr("in force"), value}) : f.tr("in force");
    f.row(f.id("calibration", i), label, value, row.active ? Mood::Good : Mood::Plain,
          row.active ? Action{} : UseCalibration{i});
  }
  list_pager(f, c.place);
  if (f.seen.calibrated)
    f.row("calibration export", f.tr("Export to the stick"), {}, Mood::Plain,
          TechnicianAct::ExportCalibration);
  f.row("calibration import", f.tr("Load from the stick"), {}, Mood::Plain, TechnicianAct::ImportCalibration);
}

void board(TechnicianFrame& f) {
  const TechnicianCalibration& c = f.seen.calibration;
  const auto stepper = [&](std::string_view id, const char* label, std::string_view value,
                           BoardMeasure measure, std::int32_t step) {
    f.stepper(id, label, value, ChangeBoard{measure, -step}, ChangeBoard{measure, step});
  };
  f.section(f.tr("The board"));
  stepper("columns", f.tr("Inner corners across"), f.number(c.columns), BoardMeasure::Columns, 1);
  stepper("rows", f.tr("Inner corners down"), f.number(c.rows), BoardMeasure::Rows, 1);
  stepper("square", f.tr("Side of a square"), f.number(c.square_mm, 1, "mm"), BoardMeasure::Square, 5);
  f.row("charuco", f.tr("With markers (ChArUco)"), c.charuco ? f.tr("yes") : f.tr("no"), Mood::Plain,
        TechnicianAct::SwitchCharuco);
  // If not, their distance must be that of the calibration in use.
  if (f.seen.calibrated)
    f.row("mounted", f.tr("The cameras were mounted anew"), c.mounted_anew ? f.tr("yes") : f.tr("no"),
          Mood::Plain, TechnicianAct::SwitchMountedAnew);
}

void at_rest(TechnicianFrame& f) {
  const TechnicianCalibration& c = f.seen.calibration;
  f.begin_list("calibration");
  verdict(f);
  board(f);
  history(f);
  f.tree.close();
  const float grow = f.open_buttons();
  const bool store = c.ended && !c.stored && c.verdict != CalibrationVerdict::Refuse;
  f.small_button("calibration begin", f.tr("Start"), icon::kCamera,
                 store ? ButtonLook::Quiet : ButtonLook::Main, TechnicianAct::BeginCalibration, grow);
  if (store)
    f.small_button("calibration store", f.tr("Store and use it"), icon::kDisk, ButtonLook::Main,
                   TechnicianAct::StoreCalibration, grow);
  f.tree.close();
}

}  // namespace

void technician_calibrate_page(TechnicianFrame& f) {
  if (!f.seen.calibration.running && list_choice(f, f.seen.calibration.place)) return;
  if (!f.seen.calibration.exported.empty())
    f.status("calibration exported",
             f.filled(f.tr("Recorded on the stick as {}. It can be pulled out."),
                      f.left_to_right(f.seen.calibration.exported)),
             Mood::Good);
  f.problem(f.seen.calibration.problem.empty() ? f.view.calibration_note : f.seen.calibration.problem);
  if (f.seen.calibration.running) running(f);
  else at_rest(f);
}

}  // namespace relievo::ui
