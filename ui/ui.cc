// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/ui.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/screens/staff_screens.h"
#include "ui/screens/visitor/visitor_screens.h"

namespace relievo::ui {
namespace {

// A picture is told where in its node it was touched.
void tell_place(Action& action, const Rect& rect, float x, float y) {
  auto* request = std::get_if<TechnicianRequest>(&action.ask);
  auto* touch = request != nullptr ? std::get_if<TouchPicture>(request) : nullptr;
  if (touch == nullptr) return;
  touch->x = std::clamp((x - rect.x) / std::max(1.0F, rect.w), 0.0F, 1.0F);
  touch->y = std::clamp((y - rect.y) / std::max(1.0F, rect.h), 0.0F, 1.0F);
}

constexpr float kSlopPx = 14;  // a finger that rests moves so far
// One that lay still so long may have gone with its panel, which was pulled out: nobody heard of its end.
constexpr std::chrono::seconds kLost{10};

}  // namespace

std::optional<Intent> Ui::take_intent() {
  if (intent_count_ == 0) return std::nullopt;
  const Intent first = intents_[0];
  std::move(intents_.begin() + 1, intents_.begin() + std::ptrdiff_t(intent_count_), intents_.begin());
  --intent_count_;
  return first;
}

void Ui::ask(std::optional<Intent> intent) {
  if (intent && intent_count_ < intents_.size()) intents_[intent_count_++] = *intent;
}

VisitRequest Ui::request() const {
  return {visit_.name(),      kConsentWording,      info_of(visit_.language).code,
          visit_.agreed_at(), visit_.quotes_code(), visit_.enrolment_kind()};
}

void Ui::feed(const Input& input, const ViewState& view) {
  if (input.kind != Input::Kind::Quit) {
    const bool asked = visit_.overlay == Overlay::StillThere;
    visit_.touched(view.now);
    service_.touched(view.now);
    if (input.kind == Input::Kind::Down) pressed_at_ = view.now;
    if (input.kind != Input::Kind::Move && input.kind != Input::Kind::Up) ask(Intent::StillHere);
    if (asked && input.kind == Input::Kind::Down) {
      acted_ = true;
      return;  // the touch that wakes does nothing else
    }
  }
  // A key that takes its time is called back by whatever comes after it.
  if (key_held_ && input.kind != Input::Kind::Move && input.kind != Input::Kind::Up) {
    key_held_ = false;
    hands_.pressed.clear();
    if (input.kind == Input::Kind::Activate) return;
  }
  switch (input.kind) {
    case Input::Kind::Down: return down(input, view);
    case Input::Kind::Move: return move(input, view);
    case Input::Kind::Up: return up(input, view);
    case Input::Kind::Next: return focus_on(1);
    case Input::Kind::Previous: return focus_on(-1);
    case Input::Kind::Left: return focus_beside(-1, 0, view);
    case Input::Kind::Right: return focus_beside(1, 0, view);
    case Input::Kind::Above: return focus_beside(0, -1, view);
    case Input::Kind::Below: return focus_beside(0, 1, view);
    case Input::Kind::Letter:
    case Input::Kind::Digit:
    case Input::Kind::Erase: return type(input, view);
    case Input::Kind::Activate: return activate_focus(view);
    case Input::Kind::Back:
      if (visit_.overlay == Overlay::None && service_.open) return service_.act(ActionKind::Back, view);
      acted_ = true;
      return ask(visit_.act(ActionKind::Back, view));
    case Input::Kind::Repeat:
      if (input.letter[0] != 0 && field() != nullptr &&
          (service_.open || (visit_.quotes_code() && visit_.name().size() < kCodeDigits)))
        return type(input, view);
      return hear(ActionKind::None, view);
    case Input::Kind::Speech: return hear(ActionKind::Speech, view);
    case Input::Kind::Quieter: return hear(ActionKind::Quieter, view);
    case Input::Kind::Louder: return hear(ActionKind::Louder, view);
    case Input::Kind::Speed: return hear(ActionKind::Speed, view);
    case Input::Kind::Quit: return;
  }
}

// Who changes how they hear it hears it again: so the change can be judged.
void Ui::hear(ActionKind kind, const ViewState& view) {
  ask(visit_.act(kind, view));
  narrator_.read_again();
}

const Utterance& Ui::speak(const ViewState& view, bool busy) {
  const bool heard = is_heard(view);
  const Listener to{Words(visit_.language), view.headphones};
  const bool begins = heard != std::exchange(heard_, heard);
  if (begins) narrator_.forget();
  // How to go on is said in the language that is understood: the first one may be another.
  if (heard && !service_.open && (std::exchange(introduced_, visit_.language) != visit_.language || begins))
    narrator_.read_again(to.tr(
        "These pages are now read to you. The arrow keys lead from one button to the next, Enter presses it. Help has volume and speed."));
  // A loudspeaker falls silent on the staff's pages; who came there by mistake hears why.
  const bool withheld = visit_.spoken && !heard;
  if (std::exchange(withheld_, withheld) != withheld && withheld)
    return narrator_.tell(to.tr("Only said into headphones"), to);
  if (!heard) return narrator_.nothing();
  // Numbers of pages that no two have in common: the visitor's, the staff's.
  const auto number = [](auto page, auto part) { return std::size_t(page) * 256 + std::size_t(part); };
  const std::size_t over = std::size_t(visit_.overlay) << 32U;
  const std::size_t page =
      service_.open ? 65536 + number(service_.page, service_.mode) : number(visit_.step, 0);
  return narrator_.follow(tree_, {over + page, focus(), view.now, busy}, to);
}

bool Ui::on_model(const Finger& finger) const {
  const Node* under = finger.down ? tree_.at(finger.start_x, finger.start_y) : nullptr;
  return under != nullptr && under->action.kind == ActionKind::TurnFace;
}

// Two fingers on a model zoom it. Elsewhere the newest counts, wherever a palm rests.
void Ui::down(const Input& input, const ViewState& view) {
  hands_.show_focus = false;
  for (Finger& finger : fingers_)
    finger.down = finger.down && finger.id != input.finger && view.now - finger.felt < kLost;
  const Node* node = tree_.at(input.x, input.y);
  auto place = std::ranges::find(fingers_, false, &Finger::down);
  if (place == fingers_.end())
    place = std::ranges::find_if(fingers_, [&](const Finger& finger) { return !on_model(finger); });
  if (place == fingers_.end()) {
    if (node != nullptr && node->action.kind == ActionKind::TurnFace) return;  // a third one on it
    place = fingers_.begin();
  }
  *place = {true, input.finger, input.x, input.y, input.x, input.y, false, view.now};
  newest_ = input.finger;
  const bool zooms = std::ranges::all_of(fingers_, [&](const Finger& finger) { return on_model(finger); });
  const bool is_button = node != nullptr && (node->role == Role::Button || node->role == Role::Key);
  const bool late = is_button && !node->hold && has_just_come(view.now);
  hands_.pressed = node != nullptr && !zooms && !late ? node->id : std::string_view{};
  if (node != nullptr && !hands_.pressed.empty() && node->dragged.kind != ActionKind::None)
    touch(*node, node->action, input, view);
}

void Ui::move(const Input& input, const ViewState& view) {
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    Finger& finger = fingers_[i];
    if (!finger.down || finger.id != input.finger) continue;
    const float old_x = finger.x, old_y = finger.y;
    finger.x = input.x;
    finger.y = input.y;
    finger.felt = view.now;
    if (std::hypot(finger.x - finger.start_x, finger.y - finger.start_y) > kSlopPx) finger.dragging = true;
    if (!finger.dragging) return;
    const Finger& other = fingers_[1 - i];
    if (on_model(finger) && on_model(other)) {
      fingers_[1 - i].felt = view.now;  // it may lie still: it holds the other end of what is zoomed
      return pinch(finger, old_x, old_y, other);
    }
    if (finger.id != newest_) return;
    const Node* node = tree_.find(hands_.pressed);
    if (node != nullptr && node->hold && !node->rect.holds(finger.x, finger.y))
      hands_.pressed.clear();  // it slid off: that is no holding
    const bool on_face = node != nullptr && node->action.kind == ActionKind::TurnFace;
    if (node != nullptr && node->dragged.kind != ActionKind::None)
      return touch(*node, node->dragged, input, view);
    if (on_face) return drag_face(finger.x - old_x, finger.y - old_y);
    if (const Node* scroller = tree_.scroller_at(finger.start_x, finger.start_y)) {
      if (hands_.scrolled != scroller->id) {
        hands_.scrolled = scroller->id;
        hands_.scroll_px = 0;
      }
      hands_.scroll_px = std::clamp(hands_.scroll_px - (finger.y - old_y), 0.0F,
                                    scroller->content_height - scroller->rect.h);
      hands_.pressed.clear();
    }
    return;
  }
}

void Ui::up(const Input& input, const ViewState& view) {
  for (Finger& finger : fingers_) {
    if (!finger.down || finger.id != input.finger) continue;
    finger.down = false;
    if (finger.id != newest_) return;
    const Node* node = tree_.at(input.x, input.y);
    if (node != nullptr && !hands_.pressed.empty() && node->id == hands_.pressed && !node->hold &&
        node->dragged.kind == ActionKind::None) {
      bring_into_view(*node);  // out from under a list's fade: it may be the chosen row now
      tap(*node, finger, input, view);
    }
    hands_.pressed.clear();
  }
}

// A model is turned by a finger that moves; one that does not sets a point, or opens what a key opens.
void Ui::tap(const Node& node, const Finger& finger, const Input& input, const ViewState& view) {
  if (node.mark != Mark::Face) return touch(node, node.action, input, view);
  if (finger.dragging) return;
  if (node.ruled && service_.ruler.on && list_.faces[node.face].model != nullptr) {
    const auto point = projection_on(node).touched(
        *list_.faces[node.face].model,
        {(input.x - node.rect.x) / node.rect.w, (input.y - node.rect.y) / node.rect.h});
    if (point) service_.ruler.set(*point);
    return;
  }
  touch(node, node.by_key.kind != ActionKind::None ? node.by_key : node.action, input, view);
}

const Node* Ui::ruled() const {
  const auto& nodes = tree_.nodes();
  const auto found = std::ranges::find_if(nodes, &Node::ruled);
  return found == nodes.end() || list_.faces[found->face].model == nullptr ? nullptr : &*found;
}

FaceProjection Ui::projection_on(const Node& face) {
  const Face& subject = list_.faces[face.face];
  if (std::exchange(stands_, subject.version) != subject.version) stand_ = stand_of(*subject.model);
  return {stand_, list_.face_look, face.rect.w / std::max(1.0F, face.rect.h),
          std::min(1.0F, face.covered_px / std::max(1.0F, face.rect.h))};
}

// Where the ruler is seen is known when the page is laid out; true: elsewhere than it was drawn.
bool Ui::follow_ruler() {
  const Node* face = ruled();
  if (face == nullptr) return false;
  const FaceProjection projection = projection_on(*face);
  FaceRuler now = service_.ruler;
  now.width_px = face->rect.w, now.height_px = face->rect.h;
  now.px_per_mm = projection.heights_per_mm() * face->rect.h;
  for (std::size_t i = 0; i < now.count; ++i) now.seen[i] = projection.seen(now.points_mm[i]);
  const bool moved = !now.stands_as(service_.ruler);
  service_.ruler = now;
  return moved;
}

void Ui::touch(const Node& node, Action action, const Input& input, const ViewState& view) {
  Node touched = node;
  touched.action = action;
  tell_place(touched.action, node.rect, input.x, input.y);
  activate(touched, view);
}

void Ui::activate(const Node& node, const ViewState& view) {
  acted_ = true;
  if (visit_.overlay == Overlay::None && service_.takes(node.action.kind)) {
    if (node.action.kind != ActionKind::TypeKey) return service_.act(node.action, view);
    service_.type(node.action.value == ' ' ? std::string_view(" ") : node.text);
    visit_.capitals = false;
    return;
  }
  if (node.action.kind == ActionKind::ReadOn) return read_on();
  if (does_nothing(node.action.kind)) return narrator_.read_again();
  if (node.action.kind == ActionKind::TypeKey)
    return visit_.type(node.action.value == ' ' ? std::string_view(" ") : node.text);
  ask(visit_.act(node.action, view));
}

void Ui::drag_face(float dx, float dy) {
  const float turn = 160.0F / float(std::min(width_px_, height_px_));
  visit_.turn_face(dx * turn, dy * turn, 80);
}

void Ui::pinch(const Finger& moved, float old_x, float old_y, const Finger& other) {
  const float before = std::hypot(old_x - other.x, old_y - other.y),
              now = std::hypot(moved.x - other.x, moved.y - other.y);
  if (before > 1) visit_.look.zoom = std::clamp(visit_.look.zoom * now / before, 0.8F, 3.0F);
}

// Who touched twice, or touched as the page before went by itself, means nothing of this one.
void Ui::comes(bool asked_for, hal::Instant now) {
  visit_.takes_touches_from = now + (asked_for ? kStruckTwice : kTooLate);
}

void Ui::frame(const ViewState& view) {
  follow_staff(view);
  const bool acted = std::exchange(acted_, false);
  // As the staff read their pages, no visitor need. Who has not signed in reads on as before.
  if (last_.page && needs_role(*last_.page) && !service_.open) visit_.forget();
  ask(visit_.follow(view));
  const Place now{visit_.step, visit_.overlay, service_.open ? std::optional(service_.page) : std::nullopt,
                  service_.mode, visit_.quotes_code()};
  const Place last = std::exchange(last_, now);
  if (now != last) {
    hands_.scrolled.clear();
    hands_.scroll_px = 0;
    hands_.pressed.clear();
    hands_.held = 0;
    key_held_ = false;
    hands_.show_focus = false;
    comes(acted, view.now);
  }
  const bool begins_anew = now.step == Step::Attract || now.step == Step::Trouble;
  if ((begins_anew && now.step != last.step) || now.page != last.page) {
    forgotten_ = true;
    visit_.look = {};
    text_->forget();
  }
  draw(view);
}

// What is held is done when its time has passed: the way in, so that a child's finger does not open it, and
// what nobody can undo.
void Ui::follow_staff(const ViewState& view) {
  const Node* held = hands_.pressed.empty() ? nullptr : tree_.find(hands_.pressed);
  hands_.held = 0;
  if (held != nullptr && held->hold) {
    const float share =
        std::clamp(std::chrono::duration<float>(view.now - pressed_at_) / std::chrono::duration<float>(kHold),
                   0.0F, 1.0F);
    if (share < 1) {
      hands_.held = share;
    } else {
      const Node node = *held;
      hands_.pressed.clear();
      key_held_ = false;
      activate(node, view);
    }
  }
  service_.follow(view);
  if (service_.open) visit_.touched(view.now);  // a member of staff has a clock of their own
}

void Ui::show(const ViewState& view, const Visit& visit, const Service& service) {
  visit_ = visit;
  service_ = service;
  draw(view);
}

void Ui::draw(const ViewState& view) {
  const Rect screen{0, 0, float(width_px_), float(height_px_)};
  const Palette& palette = service_.open ? build_staff_screen(tree_, view, visit_, service_, screen)
                                         : build_visitor_screen(tree_, view, visit_, screen);
  keep_focus();
  tree_.layout(screen, *text_, hands_);
  if (comes_to_the_end()) {
    comes(true, view.now);  // where one went on reading one agrees now
    return draw(view);
  }
  if (service_.open) fill_staff_pictures(list_, view, visit_, service_);
  else fill_pictures(list_, view, visit_);
  if (follow_ruler()) return draw(view);
  // A full atlas starts anew: then what was written before it did is written again.
  for (int round = 0; round < 2; ++round) {
    const std::uint32_t generation = text_->atlas().generation();
    list_.clear();
    tree_.paint(list_, *text_, hands_, palette.focus, unit_of(screen));
    if (text_->atlas().generation() == generation) break;
  }
}

}  // namespace relievo::ui
