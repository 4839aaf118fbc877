// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The live picture as in a mirror, the oval, one advice at a time with a sign that says the same: until the
// person stands right, and while they turn their head.
#include <algorithm>
#include <cmath>

#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

constexpr float kEdge = 12;  // of the screen: what stands there must not reach into the oval

struct Said {
  const char* words = nullptr;
  const char* letter = nullptr;
  bool good = false;
  const char* spoken = nullptr;  // to who does not see the sign, where the words need it
};

Said unseen(const Page& page) {
  return {page.tr("Look into the oval"), icon::kPerson, false,
          page.tr("The cameras do not see your face yet")};
}

// Where to move, as the person sees it in the mirror.
Said side_of(const Page& page) {
  const LiveView& live = page.view.live;
  if (std::abs(live.face_x) >= std::abs(live.face_y))
    return live.face_x > 0 ? Said{page.tr("Move a little this way"), icon::kNext, false,
                                  page.tr("Move a little to your right")}
                           : Said{page.tr("Move a little this way"), icon::kBack, false,
                                  page.tr("Move a little to your left")};
  return live.face_y > 0 ? Said{page.tr("A little higher, please"), icon::kUp}
                         : Said{page.tr("A little lower, please"), icon::kDown};
}

Said said(const Page& page) {
  using pipeline::Advice;
  const auto& tr = page.tr;
  if (page.view.live.number == 0) return {tr("The cameras are starting"), icon::kWait};
  switch (page.view.live.advice) {
    case Advice::None:
      return {tr("Very good. Look straight ahead and hold still"), icon::kGood, true};
    case Advice::NoFace:
      return unseen(page);
    case Advice::TooClose:
      return {tr("Please step back a little"), icon::kDown};
    case Advice::TooFar:
      return {tr("Please come a little closer"), icon::kUp};
    case Advice::OffCentre:
      return side_of(page);
    case Advice::TooDark:
      return {tr("It is too dark here for the cameras"), icon::kDark};
    case Advice::TooBright:
      return {tr("It is too bright: turn away from the light"), icon::kSun};
    case Advice::Moved:
    case Advice::Blurred:
      return {tr("Please hold still"), icon::kStill};
    case Advice::MoreThanOneFace:
      return {tr("One person at a time, please"), icon::kPerson};
    case Advice::TurnedAside:
      return {tr("Please look straight ahead"), icon::kPerson};
    case Advice::LooksUpOrDown:
      return {tr("Please hold your head level"), icon::kPerson};
    case Advice::Tilted:
      return {tr("Please hold your head upright"), icon::kPerson};
    case Advice::UnevenLight:
      return {tr("The light comes from one side: turn towards it"), icon::kSun};
    case Advice::Highlights:
      return {tr("Your skin reflects a lamp: turn a little"), icon::kSun};
    case Advice::FaceHidden:
      return {tr("Please uncover your whole face"), icon::kPerson};
    case Advice::EyesHidden:
      return {tr("Please uncover your eyes"), icon::kPerson};
    case Advice::EyesClosed:
      return {tr("Please open your eyes"), icon::kPerson};
    case Advice::GlassesGlare:
      return {tr("Please take off your glasses"), icon::kPerson};
    case Advice::MouthOpen:
      return {tr("Please close your mouth"), icon::kPerson};
    case Advice::NotNeutral:
      return {tr("Please relax your face"), icon::kPerson};
    case Advice::Background:
      return {tr("Please keep the space beside your head clear"), icon::kPerson};
  }
  return unseen(page);
}

// Why the person is here again.
const char* last_time(const Page& page) {
  if (page.view.attempt == 0 || page.view.trouble != Trouble::Refused) return nullptr;
  return page.tr("That did not work. Once more, please: look straight ahead and hold still.");
}

// A picture that is much narrower than the screen is seen whole, in the middle.
bool covers(const Page& page, float aspect) { return aspect > 0.75F * page.width_dp / page.height_dp; }

void picture(Page& page) {
  const ImageView& live = page.view.live.picture;
  Node node = page.box(Flow::Column);
  node.id = "live";
  node.name = page.tr("You, as in a mirror");
  node.role = Role::Picture;
  node.mark = live.empty() ? Mark::Shape : Mark::Image;
  node.picture = PictureSlot::Live;
  node.aspect = live.empty() ? 1.6F : static_cast<float>(live.width_px) / static_cast<float>(live.height_px);
  node.covers = covers(page, node.aspect);
  node.mirrored = true;
  page.tree.leaf(node);
}

// What the advice takes, and in portrait the words below it: the face is seen free of both.
float room_above(const Page& page) {
  const float line = page.text_share * (page.visit.language == Language::Arabic ? 2.3F : 1.55F);
  const float pill = kEdge + 26 + type::kButton * line;
  return page.portrait && last_time(page) != nullptr ? pill + 28 + 2 * type::kSmall * line : pill;
}

// `share` of its line is bright.
void oval(Page& page, bool good, float share) {
  Node room = page.box(Flow::Row);
  room.box.justify = Justify::Centre;
  room.box.align = Align::Centre;
  page.tree.open(room);
  // As large as a face at the best distance, as far as there is room.
  const ImageView& live = page.view.live.picture;
  const float aspect =
      live.empty() ? 1.6F : static_cast<float>(live.width_px) / static_cast<float>(live.height_px);
  const float shown =
      covers(page, aspect) ? std::max(page.width_dp, page.height_dp * aspect) : page.height_dp * aspect;
  const float wanted = page.view.live.ideal_width > 0 ? page.view.live.ideal_width * shown * 1.12F / 0.74F
                                                      : page.height_dp * 0.74F;
  const float h =
      std::min({wanted, page.height_dp * 0.76F, page.width_dp * 1.1F, page.height_dp - 2 * room_above(page)});
  Node ring = page.sized(page.box(Flow::Column), h * 0.74F, h);
  ring.id = "oval";
  ring.role = Role::Picture;
  ring.name = good ? page.tr("Your face is in the oval") : page.tr("An oval for your face");
  ring.mark = Mark::Ring;
  ring.line_px = page.px(10);
  ring.colour = {6, 10, 18, 150};
  ring.box.fill = good ? page.palette.good : Colour{255, 255, 255, 255};
  ring.box.justify = Justify::Centre;
  ring.box.align = Align::Centre;
  ring.share = share;
  page.tree.leaf(ring);
  page.tree.close();
}

void advice(Page& page, const Said& what, int countdown = 0) {
  Node row = page.box(Flow::Row);
  row.box.justify = Justify::Centre;
  page.tree.open(row);
  Node pill = page.box(Flow::Row, 18, 32, 10);
  pill.id = "advice";
  pill.role = Role::Alert;
  pill.name = what.spoken != nullptr ? what.spoken : what.words;
  pill.box.align = Align::Centre;
  pill.box.justify = Justify::Centre;
  pill.box.max_width = page.px(page.portrait ? 700.0F : 1160.0F);
  pill.box.fill = page.visit.high_contrast ? Colour{0, 0, 0, 255} : Colour{8, 14, 26, 225};
  pill.box.border = what.good ? page.palette.good : page.palette.quiet_border;
  pill.box.border_px = page.px(2);
  pill.box.radius = page.px(size::kPillRadius);
  page.tree.open(pill);
  const Colour ink = what.good ? page.palette.good : Colour{255, 255, 255, 255};
  page.sign(what.letter, 36, what.good ? page.palette.good : page.palette.warn);
  Node text = page.text(what.words, type::kButton, Weight::Medium, ink, TextAlign::Centre);
  page.tree.leaf(text);
  if (countdown != 0) {
    const char digit[] = {static_cast<char>('0' + countdown), 0};
    Node number = page.text(page.tree.keep({digit, 1}), type::kTitle, Weight::Bold, page.palette.good,
                            TextAlign::Centre);
    number.id = "countdown";
    number.role = Role::Status;
    number.style.size_px = page.px(type::kTitle * (1 + (page.text_share - 1) * 0.4F));
    page.tree.leaf(number);
  }
  page.tree.close();
  page.tree.close();
}

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
  rail.box.fill = {8, 14, 26, 200};
  rail.box.radius = page.px(kHighDp / 2);
  rail.box.left_to_right = true;
  page.tree.open(rail);
  for (std::size_t i = 0; i < pipeline::kSides; ++i) {
    const bool taken = turn && turn->taken[i];
    Node stop = pinned(static_cast<float>(pipeline::kSidesDeg[i]), kStopDp);
    stop.box.fill = taken ? page.palette.good : Colour{255, 255, 255, 40};
    stop.box.border = taken ? page.palette.good : Colour{255, 255, 255, 200};
    stop.box.border_px = page.px(2.5F);
    page.tree.open(stop);
    if (taken) page.sign(icon::kGood, 28 / page.text_share, {8, 14, 26, 255});
    page.tree.close();
  }
  if (turn && turn->advice != pipeline::TurnAdvice::Lost) {
    Node marker = pinned(std::clamp(turn->yaw_deg, 2 - kFurthestDeg, kFurthestDeg - 2), kMarkerDp);
    marker.id = "turned";
    marker.box.fill = {255, 255, 255, 255};
    page.tree.leaf(marker);
  }
  page.tree.close();
}

}  // namespace

void turn_screen(Page& page) {
  const Said what = said_of_turn(page);
  const std::size_t taken = page.view.live.turn ? page.view.live.turn->taken.count() : 0;
  Node root = page.box(Flow::Stack);
  root.id = "page";
  root.box.fill = page.palette.ground;
  page.tree.open(root);
  picture(page);
  oval(page, what.good, static_cast<float>(taken) / pipeline::kSides);
  page.tree.open(page.box(Flow::Column, space::kS, 40, kEdge));
  advice(page, what);
  page.space(1);
  if (page.portrait) {
    Node row = page.box(Flow::Row);
    row.box.justify = Justify::Centre;
    page.tree.open(row);
    sides(page);
    page.tree.close();
  }
  Node foot = page.box(Flow::Row, space::kS);
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

void position_screen(Page& page) {
  const Said what = said(page);
  const auto countdown = page.visit.countdown(page.view.live);
  Node root = page.box(Flow::Stack);
  root.id = "page";
  root.box.fill = page.palette.ground;
  page.tree.open(root);
  picture(page);
  oval(page, what.good, countdown ? 1 - *countdown / page.visit.countdown_s() : 1.0F);
  page.tree.open(page.box(Flow::Column, space::kS, 40, kEdge));
  advice(page, what, page.visit.countdown_number(page.view.live));
  if (const char* again = last_time(page); again != nullptr && !what.good) {
    Node row = page.box(Flow::Row);
    row.box.justify =
        page.portrait ? Justify::Centre : Justify::Start;  // where there is room beside the oval, there
    page.tree.open(row);
    Node note = page.text(again, type::kSmall, Weight::Medium, {255, 255, 255, 255},
                          page.portrait ? TextAlign::Centre : TextAlign::Start);
    note.id = "again";
    note.box.pad_x = page.px(24);
    note.box.pad_y = page.px(8);
    note.box.max_width = page.px(page.portrait ? 720.0F : 330.0F);
    note.box.fill = {8, 14, 26, 225};
    note.box.radius = page.px(20);
    page.tree.leaf(note);
    page.tree.close();
  }
  page.space(1);
  const bool stacked = page.portrait;
  if (stacked)
    page.button("shoot", page.tr("Take the picture"), icon::kCamera, ButtonLook::Main,
                {ActionKind::TakePicture, 0});
  Node foot = page.box(Flow::Row, page.portrait ? space::kS : space::kXs);
  foot.box.align = Align::End;
  page.tree.open(foot);
  // Large words would reach into the oval.
  if (page.portrait || page.text_share < 1.2F)
    page.button("back", page.tr("Back"), page.backward(), ButtonLook::Quiet, {ActionKind::Back, 0});
  else page.square_button("back", page.tr("Back"), page.backward(), {ActionKind::Back, 0});
  page.bigger_text();
  page.square_button("language", page.tr("Language"), icon::kTranslate, {ActionKind::ShowLanguages, 0});
  page.square_button("help", page.tr("Help"), icon::kHelp, {ActionKind::ShowHelp, 0});
  page.square_button("leave", page.tr("Stop and leave"), icon::kClose, {ActionKind::Leave, 0});
  page.space(1);
  if (!stacked)
    page.button("shoot", page.tr("Take the picture"), icon::kCamera, ButtonLook::Main,
                {ActionKind::TakePicture, 0});
  page.tree.close();
  page.tree.close();
  page.tree.close();
}

}  // namespace relievo::ui
