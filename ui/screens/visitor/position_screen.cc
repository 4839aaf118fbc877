// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Until the person stands right: where to go and what to do, one advice at a time.
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

// Where to move, as the person sees it in the mirror.
Said side_of(const Page& page) {
  const LiveView& live = page.view.live;
  if (std::abs(live.face_x) >= std::abs(live.face_y))
    return live.face_x > 0 ? Said{page.tr("Move a little to your right"), icon::kNext}
                           : Said{page.tr("Move a little to your left"), icon::kBack};
  return live.face_y > 0 ? Said{page.tr("A little higher, please"), icon::kUp}
                         : Said{page.tr("A little lower, please"), icon::kDown};
}

Said said(const Page& page) {
  using pipeline::Advice;
  const auto& tr = page.tr;
  if (page.view.screen == Screen::Capture) return {tr("Please hold still"), icon::kStill, true};
  if (page.view.live.number == 0) return {tr("The cameras are starting"), icon::kWait};
  switch (page.view.live.advice) {
    case Advice::None:
      if (!page.view.settings.is_on(Setting::Automatic))
        return {tr("Very good. Touch the button to take the picture"), icon::kCamera, true};
      return {tr("Very good. Look straight ahead and hold still"), icon::kGood, true};
    case Advice::NoFace: return unseen(page);
    case Advice::TooClose: return {tr("Please step back a little"), icon::kDown};
    case Advice::TooFar: return {tr("Please come a little closer"), icon::kUp};
    case Advice::OffCentre: return side_of(page);
    case Advice::TooDark: return {tr("It is too dark here for the cameras"), icon::kDark};
    case Advice::TooBright: return {tr("It is too bright: turn away from the light"), icon::kSun};
    case Advice::Moved:
    case Advice::Blurred: return {tr("Please hold still"), icon::kStill};
    case Advice::MoreThanOneFace: return {tr("One person at a time, please"), icon::kPerson};
    case Advice::TurnedAside:
      return {tr("Please look straight ahead"), icon::kPerson, false,
              page.view.live.yaw_deg > 0 ? tr("Turn your head slowly to your right")
                                         : tr("Turn your head slowly to your left")};
    case Advice::LooksUpOrDown:
      return {page.view.live.pitch_deg > 0 ? tr("Raise your chin a little") : tr("Lower your chin a little"),
              icon::kPerson};
    case Advice::Tilted:
      return {tr("Please hold your head upright"), icon::kPerson, false,
              page.view.live.roll_deg > 0 ? tr("Lean your head a little to your left")
                                          : tr("Lean your head a little to your right")};
    case Advice::UnevenLight: return {tr("The light comes from one side: turn towards it"), icon::kSun};
    case Advice::Highlights: return {tr("Your skin reflects a lamp: turn a little"), icon::kSun};
    case Advice::FaceHidden: return {tr("Please uncover your whole face"), icon::kPerson};
    case Advice::EyesHidden: return {tr("Please uncover your eyes"), icon::kPerson};
    case Advice::EyesClosed: return {tr("Please open your eyes"), icon::kPerson};
    case Advice::GlassesGlare: return {tr("Please take off your glasses"), icon::kPerson};
    case Advice::MouthOpen: return {tr("Please close your mouth"), icon::kPerson};
    case Advice::NotNeutral: return {tr("Please relax your face"), icon::kPerson};
    case Advice::Background: return {tr("Please keep the space beside your head clear"), icon::kPerson};
  }
  return unseen(page);
}

// Why the person is here again.
const char* last_time(const Page& page) {
  if (page.view.attempt == 0 || page.view.trouble != Trouble::Refused) return nullptr;
  return page.tr("That did not work. Once more, please: look straight ahead and hold still.");
}

Said said_of_turn(const Page& page) {
  using pipeline::TurnAdvice;
  const auto& tr = page.tr;
  // Before the first picture of the turn nothing is known of the face.
  if (!page.view.live.turn) return {tr("Please hold still"), icon::kStill};
  // In the mirror the picture's left is on the right.
  switch (page.view.live.turn->advice) {
    case TurnAdvice::ToLeft: return {tr("Turn your head slowly to your right"), icon::kNext};
    case TurnAdvice::ToRight: return {tr("Turn your head slowly to your left"), icon::kBack};
    case TurnAdvice::Level: return {tr("Please hold your head level"), icon::kPerson};
    case TurnAdvice::Slower: return {tr("A little slower, please"), icon::kStill};
    case TurnAdvice::Hold:
    case TurnAdvice::Done: return {tr("Please hold still"), icon::kGood, true};
    case TurnAdvice::Lost: break;
  }
  return unseen(page);
}

// A stop for each side, as the mirror shows them, with a tick where it is taken; between them where the head
// is.
void sides(Page& page) {
  const auto& turn = page.view.live.turn;
  constexpr float kFurthestDeg = 62, kStopDp = 46, kMarkerDp = 22;
  const auto disc_at = [&](float deg, float across_dp) {
    return pinned(centred(page.sized(page.box(Flow::Column), across_dp, across_dp)),
                  0.5F - deg / (2 * kFurthestDeg), 0.5F);
  };
  constexpr float kHighDp = kStopDp + 18;
  Node rail = left_first(page.grown(page.box(Flow::Stack)));
  // Beside large letters the button breaks its words; on a shorter rail the stops would lie on each other.
  if (!page.portrait && page.text_share > 1.6F) rail.box.grow = 0, rail.box.width = page.px(310);
  rail.box.max_width = page.px(620);
  rail.box.height = page.px(kHighDp);
  tell(rail, Role::Status, "sides", page.tr("How far it is"));
  rail.value = page.share_of(turn ? turn->taken.count() : 0, pipeline::kSides);
  frame(rail, page.palette.card, page.palette.quiet_border, page.px(2), page.px(kHighDp / 2));
  const auto in_rail = page.tree.inside(rail);
  for (std::size_t i = 0; i < pipeline::kSides; ++i) {
    const bool taken = turn && turn->taken[i];
    Node stop = disc_at(float(pipeline::kSidesDeg[i]), kStopDp);
    frame(stop, taken ? page.palette.good : page.palette.ground_end,
          taken ? page.palette.good : page.palette.quiet_border, page.px(2.5F), page.px(kStopDp / 2));
    const auto in_stop = page.tree.inside(stop);
    if (taken) page.sign(icon::kGood, 28 / page.text_share, page.palette.card);
  }
  if (turn && turn->advice != pipeline::TurnAdvice::Lost) {
    Node marker =
        page.painted(disc_at(std::clamp(turn->yaw_deg, 2 - kFurthestDeg, kFurthestDeg - 2), kMarkerDp),
                     page.palette.accent, kMarkerDp / 2);
    marker.id = "turned";
    page.tree.leaf(marker);
  }
}

}  // namespace

void position_screen(Page& page) {
  const Said what = said(page);
  const auto countdown = page.visit.countdown(page.view.live);
  const bool again_said = last_time(page) != nullptr && !what.good;
  begin_mirror(page, what, countdown ? 1 - *countdown / page.visit.countdown_s() : 1.0F, again_said);
  page.tree.open(page.box(Flow::Column, space::kS, 40, kMirrorEdge));
  advice(page, what, page.visit.countdown_number(page.view.live));
  if (again_said) {
    Node row = page.box(Flow::Row);
    row.box.justify =
        page.portrait ? Justify::Centre : Justify::Start;  // where there is room beside the oval, there
    const auto in_row = page.tree.inside(row);
    Node note = page.text(last_time(page), type::kSmall, Weight::Medium, page.palette.ink,
                          page.portrait ? TextAlign::Centre : TextAlign::Start);
    note.style.size_px *= grown_over(page) / page.text_share;
    note.id = "again";
    note.box.pad_x = page.px(24);
    note.box.pad_y = page.px(8);
    note.box.max_width = page.px(page.portrait ? 720.0F : 330.0F);
    note.box.fill = page.palette.card;
    note.box.radius = page.px(20);
    page.tree.leaf(note);
  }
  page.space(1);
  const auto shoot = [&] {
    page.button("shoot", page.tr("Take the picture"), icon::kCamera, ButtonLook::Main,
                ActionKind::TakePicture);
  };
  if (page.portrait) shoot();
  page.tree.open(
      aligned(page.sided(page.box(Flow::Row, page.portrait ? space::kS : space::kXs)), Align::End));
  // Large words would reach into the oval.
  if (page.portrait || page.text_share < 1.2F)
    page.button("back", page.tr("Back"), page.backward(), ButtonLook::Quiet, ActionKind::Back);
  else page.square_button("back", page.tr("Back"), page.backward(), ActionKind::Back);
  page.bigger_text();
  page.square_button("language", page.tr("Language"), icon::kTranslate, ActionKind::ShowLanguages);
  page.square_button("help", page.tr("Help"), icon::kHelp, ActionKind::ShowHelp);
  page.square_button("leave", page.tr("Stop and leave"), icon::kClose, ActionKind::Leave);
  page.space(1);
  if (!page.portrait) shoot();
  page.tree.close(3);
}

// While the head turns: which way, how far, which sides are taken.
void turn_screen(Page& page) {
  const Said what = said_of_turn(page);
  const std::size_t taken = page.view.live.turn ? page.view.live.turn->taken.count() : 0;
  begin_mirror(page, what, float(taken) / pipeline::kSides);
  page.tree.open(page.box(Flow::Column, space::kS, 40, kMirrorEdge));
  advice(page, what);
  page.space(1);
  if (page.portrait) {
    const auto in_row = page.tree.inside(justified(page.box(Flow::Row), Justify::Centre));
    sides(page);
  }
  page.tree.open(centred(page.sided(page.box(Flow::Row, space::kS))));
  page.square_button("help", page.tr("Help"), icon::kHelp, ActionKind::ShowHelp);
  page.square_button("leave", page.tr("Stop and leave"), icon::kClose, ActionKind::Leave);
  if (page.portrait) page.space(1);
  else sides(page);
  constexpr float kInOneLine = 1.3F;
  const float share = std::exchange(page.text_share, std::min(kInOneLine, page.text_share));
  page.button("enough", taken == 0 ? page.tr("I cannot turn my head") : page.tr("That is enough"),
              icon::kGood, ButtonLook::Main, ActionKind::EnoughSides);
  page.text_share = share;
  page.tree.close(3);
}

}  // namespace relievo::ui
