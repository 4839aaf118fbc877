// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The touch screen's correction: crosses to be touched, what came of it.
#include <cstdio>

#include "ui/device/touch_map.h"
#include "ui/screens/service/staff_pages.h"

namespace relievo::ui {
namespace {

constexpr const char* kCross = "\uf1a3";

struct Told {
  const char* words;
  Mood mood;
};

Told told(const Words& tr, TouchVerdict verdict) {
  switch (verdict) {
    case TouchVerdict::None:
      break;
    case TouchVerdict::Kept:
      return {tr("The test cross was hit. The correction is kept."), Mood::Good};
    case TouchVerdict::Plain:
      return {tr("The touch screen is taken as it is."), Mood::Good};
    case TouchVerdict::NobodyTouched:
      return {tr("Nobody touched the cross. Nothing has changed."), Mood::Warn};
    case TouchVerdict::Misfit:
      return {
          tr("The touches do not fit together. Nothing has changed: try again, with one finger, in the middle of each cross."),
          Mood::Bad};
    case TouchVerdict::Missed:
      return {tr("The test cross was missed. Nothing has changed: try again."), Mood::Bad};
    case TouchVerdict::NotSaved:
      return {tr("The correction could not be saved. Nothing has changed."), Mood::Bad};
  }
  return {nullptr, Mood::Plain};
}

// One cross in its place; what is to be done, in the middle.
void crosses(StaffFrame& page, const TouchView& seen) {
  Node room = page.grown(page.box(Flow::Stack));
  room.id = "crosses";
  page.tree.open(room);
  Node middle = page.box(Flow::Column, space::kS);
  middle.pinned = true;
  middle.pin_x = middle.pin_y = 0.5F;
  middle.box.width = page.px(page.portrait ? 480.0F : 640.0F);
  middle.box.height = page.px(220 * page.text_share);
  page.tree.open(middle);
  const bool test = seen.step == TouchStep::Test;
  page.heading("cross words",
               test ? page.tr("Now this cross, to test it") : page.tr("Touch the middle of the cross"),
               type::kHeading, TextAlign::Centre);
  char text[16];
  std::snprintf(text, sizeof text, "%d", seen.seconds_left);
  page.body("cross wait",
            page.filled(page.tr.plural("In {} second everything goes back to what it was.",
                                       "In {} seconds everything goes back to what it was.",
                                       static_cast<unsigned long>(seen.seconds_left)),
                        text),
            TextAlign::Centre);
  page.tree.close();
  const TouchPoint& at = kTouchCrosses[seen.cross];
  Node cross = page.sized(page.box(Flow::Row), 84, 84);
  tell(cross, Role::Status, "cross", page.tr("Touch the middle of the cross"));
  centre(cross);
  cross.pinned = true;
  cross.pin_x = at.x;
  cross.pin_y = at.y;
  page.tree.open(cross);
  page.sign(kCross, 72 / page.text_share, test ? page.palette.good : page.palette.accent);
  page.tree.close();
  page.tree.close();
}

void figures(StaffFrame& page, const TouchView& seen) {
  const auto& tr = page.tr;
  page.begin_list("touch");
  page.row("corrected", tr("Correction"), seen.corrected ? tr("in force") : tr("none"));
  if (seen.measured) {
    page.row("turned", tr("The panel is turned by"), page.number(seen.turned_deg, 1, "°"));
    page.row("mirrored", tr("Mirrored"), seen.mirrored ? tr("yes") : tr("no"));
    page.row("off", tr("The crosses were hit to within"), page.number(seen.off * 100, 2, "%"),
             seen.off <= kMostTouchOff ? Mood::Good : Mood::Bad);
  }
  page.line(tr(
      "Four crosses, then one to test: anything changes only if that one is hit. A keypad and a mouse always work."));
  page.tree.close();
}

}  // namespace

void touch_page(StaffFrame& page) {
  const auto& tr = page.tr;
  const TouchView* seen = page.staff.touch;
  if (seen == nullptr) return page.body("wait", tr("One moment, please"));
  if (seen->step != TouchStep::Rest) return crosses(page, *seen);
  if (const Told said = told(tr, seen->verdict); said.words != nullptr)
    page.status("verdict", said.words, said.mood);
  figures(page, *seen);
  const bool upright = page.portrait || page.text_share > 1.2F;
  page.tree.open(page.box(upright ? Flow::Column : Flow::Row, space::kS));
  page.small_button("begin", tr("Touch the crosses"), kCross, ButtonLook::Main, Action(BeginTouchTrial{}));
  if (seen->corrected)
    page.small_button("plain", tr("Take the panel as it is"), nullptr, ButtonLook::Quiet,
                      Action(TakePlainTouch{}));
  page.tree.close();
}

}  // namespace relievo::ui
