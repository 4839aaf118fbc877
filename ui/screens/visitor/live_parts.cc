// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/visitor/visitor_screens.h"

#include <algorithm>
#include <cmath>

namespace relievo::ui {
namespace {

constexpr float kUsualAspect = 1.6F;  // of a camera's picture

// A picture that is much narrower than the screen is seen whole, in the middle.
bool covers(const Page& page, float aspect) { return aspect > 0.75F * page.width_dp / page.height_dp; }

void picture(Page& page) {
  const ImageView& live = page.view.live.picture;
  Node node = page.box(Flow::Column);
  tell(node, Role::Picture, "live", page.tr("You, as in a mirror"));
  node.mark = live.empty() ? Mark::Shape : Mark::Image;
  node.picture = PictureSlot::Live;
  node.aspect = aspect_of(live, kUsualAspect);
  node.covers = covers(page, node.aspect);
  node.mirrored = true;
  page.tree.leaf(node);
}

// What the advice takes, and in portrait the words below it: the face is seen free of both.
float room_above(const Page& page, bool notes) {
  const float line = grown_over(page) * (page.visit.language == Language::Arabic ? 2.3F : 1.55F);
  const float pill = kMirrorEdge + 26 + type::kButton * line;
  return page.portrait && notes ? pill + 28 + 2 * type::kSmall * line : pill;
}

// The wide button of who cannot turn reaches under the oval.
float room_below(const Page& page) {
  return page.visit.step == Step::Turn && !page.portrait ? kMirrorEdge + size::kMainButton.height + 4 : 0.0F;
}

// Bright, as the field of a lamp; who asks for more contrast has it dark.
Colour lamp(const Page& page) {
  return page.visit.high_contrast ? Colour{0, 0, 0, 170} : Colour{255, 255, 255, 230};
}

// As far from the oval as the face is from its distance.
void distance(Page& page, float oval_high_dp) {
  const float nearness = page.view.live.nearness;
  if (nearness <= 0 || std::abs(nearness - 1) < 0.03F) return;
  const float h =
      std::min({oval_high_dp * std::clamp(nearness, 0.35F, 1.6F), page.width_dp / 0.74F, page.height_dp});
  const auto in_room = page.tree.inside(centred(page.box(Flow::Row)));
  Node ring = page.sized(page.box(Flow::Column), h * 0.74F, h);
  ring.id = "distance";
  ring.mark = Mark::Ring;
  ring.line_px = page.px(5);
  ring.box.fill = page.palette.warn;
  page.tree.leaf(ring);
}

// `share` of its line is bright.
void oval(Page& page, bool good, float share, bool notes) {
  Node room = centred(page.box(Flow::Row));
  page.tree.open(room);
  // As large as a face at the best distance, as far as there is room.
  const float aspect = aspect_of(page.view.live.picture, kUsualAspect);
  const float shown =
      covers(page, aspect) ? std::max(page.width_dp, page.height_dp * aspect) : page.height_dp * aspect;
  const float wanted = page.view.live.ideal_width > 0 ? page.view.live.ideal_width * shown * 1.12F / 0.74F
                                                      : page.height_dp * 0.74F;
  const float h =
      std::min({wanted, page.height_dp * (page.text_share > 1.6F ? 0.72F : 0.76F), page.width_dp * 1.1F,
                page.height_dp - 2 * std::max(room_above(page, notes), room_below(page))});
  Node ring = centred(page.sized(page.box(Flow::Column), h * 0.74F, h));
  tell(ring, Role::Picture, "oval",
       good ? page.tr("Your face is in the oval") : page.tr("An oval for your face"));
  ring.mark = Mark::Ring;
  ring.line_px = page.px(10);
  ring.colour = lamp(page);
  ring.box.fill = good ? page.palette.good : page.palette.accent;
  ring.share = share;
  page.tree.leaf(ring);
  page.tree.close();
  if (!good) distance(page, h);
}

// Beside the oval, or where an upright screen has a corner free.
void head(Page& page) {
  if (page.view.invitation_head == nullptr) return;
  const float side = page.portrait ? 190.0F : 250.0F;
  Node room = pinned(page.sized(page.box(Flow::Column), side, side), page.portrait ? 0.16F : 0.15F,
                     page.portrait ? 0.76F : 0.5F);
  frame(room, page.palette.stage, page.palette.card_border, page.px(2), page.px(side / 2));
  const auto in_room = page.tree.inside(room);
  Node face = page.grown(page.box(Flow::Column));
  face.id = "gesture";
  face.mark = Mark::Face;
  face.box.radius = page.px(side / 2);
  page.tree.leaf(face);
}

// From one to the other, again and again. In the mirror the picture's left is on the right.
struct Gesture {
  FaceLook from, to;
};

std::optional<Gesture> gesture_of(const LiveView& live) {
  using pipeline::Advice;
  const Advice advice = live.advice;
  if (advice == Advice::TooClose) return Gesture{{.zoom = 1.4F}, {}};
  if (advice == Advice::TooFar) return Gesture{{.zoom = 0.7F}, {}};
  if (advice == Advice::TurnedAside) return Gesture{{.yaw_deg = std::copysign(35.0F, -live.yaw_deg)}, {}};
  if (advice == Advice::LooksUpOrDown)
    return Gesture{{.pitch_deg = std::copysign(26.0F, live.pitch_deg)}, {}};
  if (advice == Advice::Tilted) return Gesture{{.roll_deg = std::copysign(24.0F, live.roll_deg)}, {}};
  return std::nullopt;
}

std::optional<Gesture> gesture_of(pipeline::TurnAdvice advice) {
  using pipeline::TurnAdvice;
  if (advice == TurnAdvice::ToLeft) return Gesture{{}, {.yaw_deg = 45}};
  if (advice == TurnAdvice::ToRight) return Gesture{{}, {.yaw_deg = -45}};
  if (advice == TurnAdvice::Level) return Gesture{{.pitch_deg = 26}, {}};
  return std::nullopt;
}

}  // namespace

std::optional<FaceLook> gesture(const ViewState& view, Step step) {
  const LiveView& live = view.live;
  const auto shown = step == Step::Turn ? live.turn ? gesture_of(live.turn->advice) : std::nullopt
                     : live.number > 0  ? gesture_of(live)
                                        : std::nullopt;
  if (!shown) return std::nullopt;
  constexpr float kMovesS = 1.4F, kRestsS = 0.9F;
  const float at =
      std::fmod(std::chrono::duration<float>(view.now.time_since_epoch()).count(), kMovesS + kRestsS);
  const float share = view.settings.is_on(Setting::Motion) ? std::min(1.0F, at / kMovesS) : 1.0F;
  const auto between = [s = share * share * (3 - 2 * share)](float a, float b) { return std::lerp(a, b, s); };
  return FaceLook{.yaw_deg = between(shown->from.yaw_deg, shown->to.yaw_deg),
                  .pitch_deg = between(shown->from.pitch_deg, shown->to.pitch_deg),
                  .roll_deg = between(shown->from.roll_deg, shown->to.roll_deg),
                  .zoom = between(shown->from.zoom, shown->to.zoom),
                  .textured = false};
}

Said unseen(const Page& page) {
  return {page.tr("Look into the oval"), icon::kPerson, false,
          page.tr("The cameras do not see your face yet")};
}

float grown_over(const Page& page) { return 1 + (page.text_share - 1) * 0.45F; }

void begin_mirror(Page& page, const Said& what, float share, bool notes) {
  Node root = page.painted(page.box(Flow::Stack),
                           page.visit.high_contrast ? page.palette.ground : Colour{255, 255, 255, 255});
  root.id = "page";
  page.tree.open(root);
  picture(page);
  oval(page, what.good, share, notes);
  if (gesture(page.view, page.visit.step)) head(page);
}

void advice(Page& page, const Said& what, int countdown) {
  const auto in_row = page.tree.inside(justified(page.box(Flow::Row), Justify::Centre));
  Node pill = centred(page.box(Flow::Row, 18, 32, 10));
  tell(pill, Role::Alert, "advice", what.spoken != nullptr ? what.spoken : what.words);
  pill.insists = !what.good;
  // Who turns the head is past the side before they have heard.
  pill.waits = pill.insists && page.visit.step == Step::Position;
  pill.box.max_width = page.px(page.portrait ? 700.0F : 1200.0F);
  frame(pill, page.palette.card, what.good ? page.palette.good : page.palette.quiet_border, page.px(3),
        page.px(size::kPillRadius));
  pill.box.shadow = true;
  const auto in_pill = page.tree.inside(pill);
  const Colour ink = what.good ? page.palette.good : page.palette.ink;
  // Sign and words grow alike: in one line they leave the oval free.
  const float grown = grown_over(page) / page.text_share;
  page.sign(what.letter, 36 * grown, what.good ? page.palette.good : page.palette.warn);
  Node text = page.text(what.words, type::kButton, Weight::Medium, ink, TextAlign::Centre);
  text.style.size_px *= grown;
  page.tree.leaf(text);
  if (countdown != 0) {
    const char digit[] = {char('0' + countdown), 0};
    Node number = page.text(page.tree.keep({digit, 1}), type::kTitle, Weight::Bold, page.palette.good,
                            TextAlign::Centre);
    number.style.size_px = page.px(type::kTitle * (1 + (page.text_share - 1) * 0.15F));
    number.box.width = 0.7F * number.style.size_px;  // words give way, a digit cannot
    page.put("countdown", Role::Status, number);
  }
}

}  // namespace relievo::ui
