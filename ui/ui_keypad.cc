// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ui without a finger: where the focus goes, what is typed, what is read on.
#include <algorithm>
#include <cmath>

#include "ui/ui.h"

namespace relievo::ui {
namespace {

constexpr float kScreenful = 0.7F;  // the last lines of one are seen again, and none lies under a fade

}  // namespace

// A keypad has no finger that rests. What must not happen by mistake takes the same time here, and nobody has
// to keep a key down.
void Ui::activate_focus(const ViewState& view) {
  const Node* node = focused();
  if (node == nullptr && !hands_.show_focus) {  // who types has the focus where they type
    if (has_just_come(view.now)) return;
    node = field();
    if (node != nullptr && node->by_key.kind == ActionKind::None) return;
  }
  if (node == nullptr) return;
  if (node->by_key.kind != ActionKind::None) {
    Node pressed = *node;
    pressed.action = node->by_key;
    return activate(pressed, view);
  }
  if (node->action.kind == ActionKind::None) return;
  if (!node->slow_key) return activate(*node, view);
  hands_.pressed = node->id;
  pressed_at_ = view.now;
  key_held_ = true;
}

// A key that has changed its letter keeps the focus: who types a capital goes on from where they are.
void Ui::keep_focus() {
  if (!hands_.show_focus) return;
  if (const Node* node = tree_.find(hands_.focus)) {
    focus_at_ = std::size_t(node - tree_.nodes().data());
  } else if (focus_at_ < tree_.nodes().size() && tree_.nodes()[focus_at_].role == Role::Key) {
    hands_.focus = tree_.nodes()[focus_at_].id;
  }
}

void Ui::focus_on(int direction) {
  const Node* at = focused();
  move_focus(at, tree_.after(at != nullptr ? at : before_content(), direction), direction);
}

// What a page asks comes first, not the tools above it; the staff's title stands among those: behind the sign
// of the last.
const Node* Ui::before_content() const {
  const Node *question = tree_.question(), *last = tree_.find(kBarsEnd);
  if (last == nullptr || !tree_.is_on_top(*last) || (question != nullptr && question > last)) return question;
  return &tree_.nodes()[std::size_t(last->first_child)];
}

// Who listens goes through everything in its order.
void Ui::focus_beside(float right, float down, const ViewState& view) {
  const Node* at = focused();
  const int direction = right + down > 0 ? 1 : -1;
  if (is_heard(view) || at == nullptr) return focus_on(direction);
  const Node* next = tree_.beside(*at, right, down);
  if (down != 0) return move_focus(at, next, direction);
  if (next != nullptr) move_focus(nullptr, next, direction);
}

// What goes on is read to its end before the focus leaves it.
void Ui::move_focus(const Node* at, const Node* next, int direction) {
  const Node* left = at == nullptr ? nullptr : at->box.scroll ? at : tree_.scroller_around(*at);
  const bool leaves =
      left != nullptr && (next == nullptr || next == left || tree_.scroller_around(*next) != left);
  const bool turns_round = left != nullptr && next != nullptr && (direction > 0) != (next > at);
  if ((leaves || turns_round) &&
      scroll(*left, scrolled_px(*left) + float(direction) * kScreenful * left->rect.h))
    return;
  if (next == nullptr) return;
  hands_.show_focus = true;
  hands_.focus = next->id;
  bring_into_view(*next);
}

const Node* Ui::field() const {
  const auto found = std::ranges::find_if(
      tree_.nodes(), [&](const Node& node) { return node.role == Role::Field && tree_.is_on_top(node); });
  return found == tree_.nodes().end() ? nullptr : &*found;
}

// Letters go where letters are asked for. A blank there that follows nothing, and elsewhere, presses what has
// the focus.
void Ui::type(const Input& input, const ViewState& view) {
  const Node* asked = field();
  const std::string_view letter(input.letter.data());
  if (asked == nullptr || (letter == " " && asked->value.empty())) {
    if (letter == " ") activate_focus(view);
    return;
  }
  if (input.kind == Input::Kind::Erase) {
    if (service_.open) return service_.act(ActionKind::Erase, view);
    return ask(visit_.act(ActionKind::Erase, view));
  }
  if (service_.open) return service_.type(letter);
  if (does_nothing(ActionKind::TypeKey)) return narrator_.read_again();
  if (input.kind == Input::Kind::Digit) return visit_.type_by_digit(letter[0], view.now);
  visit_.type(letter);
}

// A code that is whole takes no further digit; one that is not, and no name, cannot be handed in: who listens
// hears how it stands.
bool Ui::does_nothing(ActionKind kind) const {
  if (visit_.step != Step::Name || service_.open) return false;
  if (!visit_.quotes_code()) return kind == ActionKind::Done && visit_.name().empty();
  const bool whole = visit_.name().size() == kCodeDigits;
  return (kind == ActionKind::TypeKey && whole) || (kind == ActionKind::Done && !whole);
}

bool Ui::scroll(const Node& scroller, float to_px) {
  const float to = std::clamp(to_px, 0.0F, std::max(0.0F, scroller.content_height - scroller.rect.h)),
              before = scrolled_px(scroller);
  if (std::abs(to - before) < 1) return false;
  hands_.scrolled = scroller.id;
  hands_.scroll_px = to;
  return true;
}

void Ui::read_on() {
  if (const Node* text = tree_.find(kToRead))
    (void)scroll(*text, scrolled_px(*text) + kScreenful * text->rect.h);
}

// True: the end of what one agrees to is on the screen for the first time, and the page changes with it.
bool Ui::comes_to_the_end() {
  const Node* text =
      service_.open || visit_.step != Step::Consent || visit_.has_read() ? nullptr : tree_.find(kToRead);
  if (text == nullptr || text->content_height > text->rect.h + scrolled_px(*text) + 1) return false;
  visit_.reads_to_the_end();
  return true;
}

void Ui::bring_into_view(const Node& node) {
  const Node* scroller = tree_.scroller_around(node);
  if (scroller == nullptr) return;
  const Rect& room = scroller->rect;
  const float margin = std::max(
      0.0F, std::min(room.h / 4, (room.h - node.rect.h) / 2));  // as high as a fade, where there is room
  const float above = room.y + margin - node.rect.y, below = node.rect.bottom() - (room.bottom() - margin);
  if (above > 0) scroll(*scroller, scrolled_px(*scroller) - above);
  else if (below > 0) scroll(*scroller, scrolled_px(*scroller) + below);
}

}  // namespace relievo::ui
