// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// While the head turns: which way, how far, which sides are taken.
#include <algorithm>

#include "ui/screens/visitor/live_parts.h"
#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

Said said_of_turn(const Page& page) {
  using pipeline::TurnAdvice;
  const auto& tr = page.tr;
  // In the mirror the picture's left is on the right.
  const char* const on = tr("Turn your head slowly this way");
  switch (page.view.live.turn ? page.view.live.turn->advice : TurnAdvice::Hold) {
    case TurnAdvice::ToLeft:
      return {on, icon::kNext, false, tr("Turn your head slowly to your right")};
    case TurnAdvice::ToRight:
      return {on, icon::kBack, false, tr("Turn your head slowly to your left")};
    case TurnAdvice::Level:
      return {tr("Please hold your head level"), icon::kPerson};
    case TurnAdvice::Slower:
      return {tr("A little slower, please"), icon::kStill};
    case TurnAdvice::Hold:
    case TurnAdvice::Done:
      return {tr("Please hold still"), icon::kGood, true};
    case TurnAdvice::Lost:
      break;
  }
  return unseen(page);
}

// A stop for each side, as the mirror shows them, with a tick where it is taken; between them where the head
// is.
void sides(Page& page) {
  const auto& turn = page.view.live.turn;
  constexpr float kFurthestDeg = 62, kStopDp = 46, kMarkerDp = 22;
  const auto pinned = [&](float deg, float across_dp) {
    Node disc = page.sized(page.box(Flow::Column), across_dp, across_dp);
    disc.pinned = true;
    disc.pin_x = 0.5F - deg / (2 * kFurthestDeg);
    disc.pin_y = 0.5F;
    disc.box.radius = page.px(across_dp / 2);
    disc.box.justify = Justify::Centre;
    disc.box.align = Align::Centre;
    return disc;
  };
  constexpr float kHighDp = kStopDp + 18;
  Node rail = page.grown(page.box(Flow::Stack));
  rail.box.max_width = page.px(620);
  rail.box.height = page.px(kHighDp);
  rail.id = "sides";
  rail.role = Role::Status;
  rail.name = page.tr("How far you are");
  rail.value = page.share_of(turn ? turn->taken.count() : 0, pipeline::kSides);
  rail.box.fill = page.palette.card;
  rail.box.border = page.palette.quiet_border;
  rail.box.border_px = page.px(2);
  rail.box.radius = page.px(kHighDp / 2);
  rail.box.left_to_right = true;
  page.tree.open(rail);
  for (std::size_t i = 0; i < pipeline::kSides; ++i) {
    const bool taken = turn && turn->taken[i];
    Node stop = pinned(static_cast<float>(pipeline::kSidesDeg[i]), kStopDp);
    stop.box.fill = taken ? page.palette.good : page.palette.ground_end;
    stop.box.border = taken ? page.palette.good : page.palette.quiet_border;
    stop.box.border_px = page.px(2.5F);
    page.tree.open(stop);
    if (taken) page.sign(icon::kGood, 28 / page.text_share, page.palette.card);
    page.tree.close();
  }
  if (turn && turn->advice != pipeline::TurnAdvice::Lost) {
    Node marker = pinned(std::clamp(turn->yaw_deg, 2 - kFurthestDeg, kFurthestDeg - 2), kMarkerDp);
    marker.id = "turned";
    marker.box.fill = page.palette.accent;
    page.tree.leaf(marker);
  }
  page.tree.close();
}

}  // namespace

void turn_screen(Page& page) {
  const Said what = said_of_turn(page);
  const std::size_t taken = page.view.live.turn ? page.view.live.turn->taken.count() : 0;
  begin_mirror(page, what, static_cast<float>(taken) / pipeline::kSides);
  page.tree.open(page.box(Flow::Column, space::kS, 40, kMirrorEdge));
  advice(page, what);
  page.space(1);
  if (page.portrait) {
    Node row = page.box(Flow::Row);
    row.box.justify = Justify::Centre;
    page.tree.open(row);
    sides(page);
    page.tree.close();
  }
  Node foot = page.sided(page.box(Flow::Row, space::kS));
  foot.box.align = Align::Centre;
  foot.box.justify = Justify::Centre;
  page.tree.open(foot);
  page.square_button("help", page.tr("Help"), icon::kHelp, {ActionKind::ShowHelp, 0});
  page.square_button("leave", page.tr("Stop and leave"), icon::kClose, {ActionKind::Leave, 0});
  if (page.portrait) page.space(1);
  else sides(page);
  page.button("enough", taken == 0 ? page.tr("I cannot turn my head") : page.tr("That is enough"),
              icon::kGood, ButtonLook::Main, {ActionKind::EnoughSides, 0});
  page.tree.close();
  page.tree.close();
  page.tree.close();
}

}  // namespace relievo::ui
