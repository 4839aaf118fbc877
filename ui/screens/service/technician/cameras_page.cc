// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both cameras, live, side by side, or the left one and its relief: light, focus, and whether they expose at
// the same instant.
#include <cstdlib>

#include "ui/screens/service/technician/technician_frame.h"

namespace relievo::ui {
namespace {

constexpr float kBurntOut = 0.02F, kTooDark = 0.12F, kSharpEnough = 0.9F;

void live(TechnicianFrame& b, std::string_view id, const char* title, const TechnicianPicture& picture,
          PictureSlot slot) {
  Node column = b.page.grown(b.page.box(Flow::Column, 6));
  column.box.justify = Justify::Centre;
  b.page.tree.open(column);
  b.page.tree.leaf(b.page.text(title, type::kSmall, Weight::Bold, b.page.palette.ink, TextAlign::Centre));
  b.open_picture(id, title, picture, slot);
  b.close_picture();
  b.page.tree.close();
}

// A label, and the figure of the left and of the right camera, on their sides in every language.
void pair_row(TechnicianFrame& b, std::string_view id, const char* label, std::string_view left,
              std::string_view right, Mood left_mood, Mood right_mood) {
  Node row = b.page.box(Flow::Row, space::kS, 0, 6);
  row.id = id;
  row.box.align = Align::Centre;
  row.box.min_height = b.page.px(44);
  b.page.tree.open(row);
  b.page.tree.open(b.page.grown(b.page.box(Flow::Column), 1.4F));
  b.page.tree.leaf(b.page.text(label, type::kSmall, Weight::Medium, b.page.palette.ink));
  b.page.tree.close();
  Node both = b.page.grown(b.page.box(Flow::Row, space::kS), 2);
  both.box.left_to_right = true;
  b.page.tree.open(both);
  for (std::size_t side = 0; side < 2; ++side) {
    const Mood mood = side == 0 ? left_mood : right_mood;
    Node cell = b.page.grown(b.page.box(Flow::Row, space::kXs));
    cell.box.align = Align::Centre;
    b.page.tree.open(cell);
    if (const char* letter = b.page.sign_of(mood)) b.page.sign(letter, 22, b.page.ink_of(mood));
    b.page.tree.leaf(b.page.text(side == 0 ? left : right, type::kSmall, Weight::Regular,
                                 mood == Mood::Plain ? b.page.palette.ink_soft : b.page.ink_of(mood)));
    b.page.tree.close();
  }
  b.page.tree.close();
  b.page.tree.close();
}

void figures(TechnicianFrame& b) {
  const TechnicianCameras& c = b.view.cameras;
  const auto both = [&](std::string_view id, const char* label, auto value, int decimals,
                        const char* unit_name, auto mood) {
    pair_row(b, id, label, b.page.number(static_cast<double>(value(c.camera[0])), decimals, unit_name),
             b.page.number(static_cast<double>(value(c.camera[1])), decimals, unit_name), mood(c.camera[0]),
             mood(c.camera[1]));
  };
  const auto plain = [](const TechnicianCamera&) { return Mood::Plain; };
  both(
      "brightness", b.tr("Brightness of the middle"), [](const TechnicianCamera& x) { return 100 * x.mean; },
      0, "%", [](const TechnicianCamera& x) { return x.mean < kTooDark ? Mood::Warn : Mood::Good; });
  both(
      "clipped", b.tr("Overexposed"), [](const TechnicianCamera& x) { return 100 * x.clipped; }, 1, "%",
      [](const TechnicianCamera& x) { return x.clipped > kBurntOut ? Mood::Warn : Mood::Good; });
  both(
      "focus", b.tr("Focus, of the best so far"), [](const TechnicianCamera& x) { return 100 * x.focus; }, 0,
      "%", [](const TechnicianCamera& x) { return x.focus < kSharpEnough ? Mood::Warn : Mood::Good; });
  both(
      "frames", b.tr("Pictures"), [](const TechnicianCamera& x) { return x.frames; }, 0, "", plain);
  both(
      "lost", b.tr("Lost"), [](const TechnicianCamera& x) { return x.lost; }, 0, "",
      [](const TechnicianCamera& x) { return x.lost > 0 ? Mood::Warn : Mood::Good; });
  both(
      "damaged", b.tr("Damaged"), [](const TechnicianCamera& x) { return x.damaged; }, 0, "",
      [](const TechnicianCamera& x) { return x.damaged > 0 ? Mood::Warn : Mood::Good; });
  b.page.section(b.tr("Together"));
  b.page.row("skew", b.tr("Apart in time"), b.page.number(static_cast<double>(c.skew_us), 0, "µs"));
  b.page.row("pairs", b.tr("Pairs"), b.page.number(static_cast<double>(c.pairs)));
  b.page.row("apart", b.tr("Refused: too far apart"), b.page.number(static_cast<double>(c.apart)),
             c.apart > 0 ? Mood::Warn : Mood::Good);
  b.page.row("rate", b.tr("Pairs a second"), b.page.number(static_cast<double>(c.pairs_per_second), 1));
  b.page.row("exposure", b.tr("Exposure"), b.page.number(static_cast<double>(c.exposure_us) / 1000, 2, "ms"));
  if (!c.can_be_set) b.page.row("fixed", b.tr("The exposure of these cameras cannot be set."), {});
}

}  // namespace

void technician_cameras_page(StaffFrame& page) {
  if (page.staff.technician == nullptr) return;
  TechnicianFrame b(page);
  b.problem(b.view.problem.empty() ? b.view.cameras.problem : b.view.problem);
  page.tree.open(page.grown(page.box(page.portrait ? Flow::Column : Flow::Row, space::kM)));
  Node pair = page.grown(page.box(Flow::Row, space::kS), b.picture_share(1.5F));
  pair.box.left_to_right = true;
  page.tree.open(pair);
  const TechnicianCameras& cameras = b.view.cameras;
  live(b, "left live", b.tr("Left camera"), cameras.camera[0].picture, PictureSlot::TechnicianLeft);
  if (cameras.relief_shown)
    live(b, "relief", b.tr("Relief: near is bright"), cameras.relief, PictureSlot::TechnicianRight);
  else live(b, "right live", b.tr("Right camera"), cameras.camera[1].picture, PictureSlot::TechnicianRight);
  page.tree.close();
  page.tree.open(page.grown(page.box(Flow::Column)));
  page.begin_panel("camera figures");
  if (b.view.cameras.watched) figures(b);
  else page.line(b.tr("One moment, please"));
  page.tree.close();
  page.tree.close();
  page.tree.close();
  const float grow = b.open_buttons();
  if (b.view.cameras.can_be_set) {
    page.small_button("darker", b.tr("Darker"), icon::kDark, ButtonLook::Quiet,
                      technician_action(TechnicianAct::DarkerShot), grow);
    page.small_button("brighter", b.tr("Brighter"), icon::kSun, ButtonLook::Quiet,
                      technician_action(TechnicianAct::BrighterShot), grow);
    if (page.portrait) page.tree.close(), b.open_buttons();  // two and two
  }
  if (b.view.cameras.watched)
    b.choice("show relief", b.tr("Relief"), b.view.cameras.relief_shown,
             technician_action(TechnicianAct::ShowRelief), grow);
  page.small_button("watch", b.view.cameras.watched ? b.tr("Stop") : b.tr("Watch"),
                    b.view.cameras.watched ? icon::kClose : icon::kCamera, ButtonLook::Main,
                    technician_action(TechnicianAct::WatchCameras), grow);
  page.tree.close();
}

}  // namespace relievo::ui
