// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both cameras, live, side by side, or the left one and its relief: light, focus, and whether they expose at
// the same instant.

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

constexpr float kBurntOut = 0.02F, kTooDark = 0.12F, kSharpEnough = 0.9F;

// Touched, a camera's picture fills the page: mode 1 the left one's, 2 the right one's.
void live(TechnicianFrame& f, std::string_view id, const char* title, const TechnicianPicture& picture,
          PictureSlot slot, int mode) {
  Node column = f.page.grown(f.page.box(Flow::Column, 6));
  column.box.justify = Justify::Centre;
  const auto in_column = f.page.tree.inside(column);
  f.page.tree.leaf(f.page.text(title, type::kSmall, Weight::Bold, f.page.palette.ink, TextAlign::Centre));
  const bool opens = mode > 0 && !picture.pixels.empty();
  f.open_picture(id, opens ? f.page.filled("{}: {}", {title, f.tr("Larger")}) : title, picture, slot,
                 opens ? Action(ActionKind::StaffMode, mode) : Action());
  f.close_picture();
}

void edges_button(TechnicianFrame& f, float grow) {
  f.choice("show edges", f.tr("Sharp edges"), f.view.cameras.edges_shown,
           technician_action(TechnicianAct::ShowEdges), grow);
}

// What a hand at the lens looks at.
void focus_card(TechnicianFrame& f, const TechnicianCamera& camera) {
  Node row = f.page.box(Flow::Row, space::kM, space::kM, space::kXs);
  row.box.align = Align::Centre;
  frame(row, f.page.palette.card, f.page.palette.card_border, f.page.px(1.5F), f.page.px(18));
  const auto in_row = f.page.tree.inside(row);
  f.page.tree.open(f.page.grown(f.page.box(Flow::Column)));
  const auto figure = [&](std::string_view id, const char* label, float share, int decimals) {
    Node said =
        f.page.text(f.page.filled("{}: {}", {label, f.page.number(100 * double(share), decimals, "%")}), 18,
                    Weight::Medium, f.page.palette.ink);
    said.id = id;
    said.style.tabular = true;
    f.page.tree.leaf(said);
  };
  figure("whole focus", f.tr("Focus, of the best so far"), camera.focus, 0);
  if (f.view.cameras.edges_shown) figure("whole edges", f.tr("Sharp edges"), camera.sharp_edges, 1);
  f.page.tree.close();
  edges_button(f, 0);
}

// One picture, and the figures below it.
void whole_page(TechnicianFrame& f, std::size_t side) {
  const TechnicianCamera& camera = f.view.cameras.camera[side];
  f.open_picture(
      "whole",
      f.page.filled("{}: {}", {side == 0 ? f.tr("Left camera") : f.tr("Right camera"), f.tr("Back")}),
      camera.picture, side == 0 ? PictureSlot::TechnicianLeft : PictureSlot::TechnicianRight,
      {ActionKind::StaffMode, 0});
  f.close_picture();
  focus_card(f, camera);
}

// A label, and the figure of the left and of the right camera, on their sides in every language.
void pair_row(TechnicianFrame& f, std::string_view id, const char* label, std::string_view left,
              std::string_view right, Mood left_mood, Mood right_mood) {
  Node row = f.page.box(Flow::Row, space::kS, 0, 6);
  row.id = id;
  row.box.align = Align::Centre;
  row.box.min_height = f.page.px(44);
  const auto in_row = f.page.tree.inside(row);
  f.page.tree.open(f.page.grown(f.page.box(Flow::Column), 1.4F));
  f.page.tree.leaf(f.page.text(label, type::kSmall, Weight::Medium, f.page.palette.ink));
  f.page.tree.close();
  Node both = f.page.grown(f.page.box(Flow::Row, space::kS), 2);
  both.box.left_to_right = true;
  const auto in_both = f.page.tree.inside(both);
  for (std::size_t side = 0; side < 2; ++side) {
    const Mood mood = side == 0 ? left_mood : right_mood;
    Node cell = f.page.grown(f.page.box(Flow::Row, space::kXs));
    cell.box.align = Align::Centre;
    const auto in_cell = f.page.tree.inside(cell);
    if (const char* letter = f.page.sign_of(mood)) f.page.sign(letter, 22, f.page.ink_of(mood));
    f.page.tree.leaf(f.page.text(side == 0 ? left : right, type::kSmall, Weight::Regular,
                                 mood == Mood::Plain ? f.page.palette.ink_soft : f.page.ink_of(mood)));
  }
}

void figures(TechnicianFrame& f) {
  const TechnicianCameras& c = f.view.cameras;
  const auto both = [&](std::string_view id, const char* label, auto value, int decimals,
                        const char* unit_name, auto mood) {
    pair_row(f, id, label, f.page.number(double(value(c.camera[0])), decimals, unit_name),
             f.page.number(double(value(c.camera[1])), decimals, unit_name), mood(c.camera[0]),
             mood(c.camera[1]));
  };
  const auto plain = [](const TechnicianCamera&) { return Mood::Plain; };
  both(
      "brightness", f.tr("Brightness of the middle"), [](const TechnicianCamera& x) { return 100 * x.mean; },
      0, "%", [](const TechnicianCamera& x) { return x.mean < kTooDark ? Mood::Warn : Mood::Good; });
  both(
      "clipped", f.tr("Overexposed"), [](const TechnicianCamera& x) { return 100 * x.clipped; }, 1, "%",
      [](const TechnicianCamera& x) { return x.clipped > kBurntOut ? Mood::Warn : Mood::Good; });
  both(
      "focus", f.tr("Focus, of the best so far"), [](const TechnicianCamera& x) { return 100 * x.focus; }, 0,
      "%", [](const TechnicianCamera& x) { return x.focus < kSharpEnough ? Mood::Warn : Mood::Good; });
  if (c.edges_shown)
    both(
        "edges", f.tr("Sharp edges"), [](const TechnicianCamera& x) { return 100 * x.sharp_edges; }, 1, "%",
        plain);
  both(
      "frames", f.tr("Pictures"), [](const TechnicianCamera& x) { return x.frames; }, 0, "", plain);
  both(
      "lost", f.tr("Lost"), [](const TechnicianCamera& x) { return x.lost; }, 0, "",
      [](const TechnicianCamera& x) { return x.lost > 0 ? Mood::Warn : Mood::Good; });
  both(
      "damaged", f.tr("Damaged"), [](const TechnicianCamera& x) { return x.damaged; }, 0, "",
      [](const TechnicianCamera& x) { return x.damaged > 0 ? Mood::Warn : Mood::Good; });
  f.page.section(f.tr("Together"));
  f.page.row("skew", f.tr("Apart in time"), f.page.number(double(c.skew_us), 0, "µs"));
  f.page.row("pairs", f.tr("Pairs"), f.page.number(double(c.pairs)));
  f.page.row("apart", f.tr("Refused: too far apart"), f.page.number(double(c.apart)),
             c.apart > 0 ? Mood::Warn : Mood::Good);
  f.page.row("rate", f.tr("Pairs a second"), f.page.number(double(c.pairs_per_second), 1));
  f.page.row("exposure", f.tr("Exposure"), f.page.number(double(c.exposure_us) / 1000, 2, "ms"));
  if (!c.can_be_set) f.page.row("fixed", f.tr("The exposure of these cameras cannot be set."), {});
}

}  // namespace

void technician_cameras_page(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame f(page);
  f.problem(f.view.problem.empty() ? f.view.cameras.problem : f.view.problem);
  if (page.service.mode > 0 && f.view.cameras.watched)
    return whole_page(f, std::size_t(page.service.mode == 1 ? 0 : 1));
  page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
  Node pair = page.grown(page.box(Flow::Row, space::kS), f.picture_share(1.5F));
  pair.box.left_to_right = true;
  page.tree.open(pair);
  const TechnicianCameras& cameras = f.view.cameras;
  live(f, "left live", f.tr("Left camera"), cameras.camera[0].picture, PictureSlot::TechnicianLeft, 1);
  if (cameras.relief_shown)
    live(f, "relief", f.tr("Relief"), cameras.relief, PictureSlot::TechnicianRight, 0);
  else
    live(f, "right live", f.tr("Right camera"), cameras.camera[1].picture, PictureSlot::TechnicianRight, 2);
  page.tree.close();
  page.tree.open(page.grown(page.box(Flow::Column)));
  page.begin_panel("camera figures");
  if (f.view.cameras.watched) figures(f);
  else page.line(f.tr("One moment, please"));
  page.tree.close();
  page.tree.close();
  page.tree.close();
  const float grow = f.open_buttons();
  if (f.view.cameras.can_be_set) {
    page.small_button("darker", f.tr("Darker"), icon::kDark, ButtonLook::Quiet,
                      technician_action(TechnicianAct::DarkerShot), grow);
    page.small_button("brighter", f.tr("Brighter"), icon::kSun, ButtonLook::Quiet,
                      technician_action(TechnicianAct::BrighterShot), grow);
    if (page.portrait) page.tree.close(), f.open_buttons();  // two and two
  }
  if (f.view.cameras.watched) edges_button(f, grow);
  if (f.view.cameras.watched)
    f.choice("show relief", f.tr("Relief"), f.view.cameras.relief_shown,
             technician_action(TechnicianAct::ShowRelief), grow);
  page.small_button("watch", f.view.cameras.watched ? f.tr("Stop") : f.tr("Watch"),
                    f.view.cameras.watched ? icon::kClose : icon::kCamera, ButtonLook::Main,
                    technician_action(TechnicianAct::WatchCameras), grow);
  page.tree.close();
}

}  // namespace relievo::ui
