// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/tree/tree.h"

#include <string.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/base/assert.h"

namespace relievo::ui {
namespace {

constexpr std::size_t kNodes = 2048, kDepth = 32, kStringBytes = 128 * 1024;

constexpr float kAcross = 3, kOff = 0.1F;  // against the way itself, where a keypad looks for the next

bool touchable(const Node& node) { return node.action.kind != ActionKind::None; }
bool goes_on(const Node& node) { return !node.id.empty() && node.overflows(); }

}  // namespace

Tree::Tree() : strings_(kStringBytes) {
  nodes_.reserve(kNodes);
  open_.reserve(kDepth);
}

void Tree::begin(bool right_to_left) {
  nodes_.clear();
  spots_.clear();
  open_.clear();
  explicit_bzero(strings_.data(), strings_used_);  // the page before may have shown a name or a code
  strings_used_ = 0;
  right_to_left_ = right_to_left;
  modal_ = -1;
}

std::string_view Tree::keep(std::string_view text) {
  RELIEVO_ASSERT(strings_used_ + text.size() <= strings_.size());
  char* to = strings_.data() + strings_used_;
  text.copy(to, text.size());
  strings_used_ += text.size();
  return {to, text.size()};
}

void Tree::mark(const Spot& spot) {
  Node& node = nodes_.back();
  if (node.spots++ == 0) node.first_spot = std::uint32_t(spots_.size());
  spots_.push_back(spot);
}

Node& Tree::leaf(const Node& node) {
  RELIEVO_ASSERT(nodes_.size() < kNodes);
  const auto index = std::int32_t(nodes_.size());
  nodes_.push_back(node);
  Node& added = nodes_.back();
  added.first_child = added.last_child = added.next = -1;
  added.children = 0;
  added.parent = open_.empty() ? -1 : open_.back();
  added.style.right_to_left = right_to_left_;
  if (added.modal) modal_ = index;
  if (!open_.empty()) {
    Node& parent = nodes_[std::size_t(open_.back())];
    ++parent.children;
    RELIEVO_ASSERT(parent.box.flow != Flow::Row || parent.children <= kMostInARow);
    if (parent.last_child >= 0) nodes_[std::size_t(parent.last_child)].next = index;
    else parent.first_child = index;
    parent.last_child = index;
  }
  return added;
}

Node& Tree::open(const Node& node) {
  Node& added = leaf(node);
  open_.push_back(std::int32_t(nodes_.size()) - 1);
  return added;
}

bool Tree::under_modal(std::size_t index) const {
  if (modal_ < 0) return false;
  for (auto at = std::int32_t(index); at >= 0; at = nodes_[std::size_t(at)].parent) {
    if (at == modal_) return false;
  }
  return true;
}

const Node* Tree::find(std::string_view id) const {
  const auto found = std::ranges::find(nodes_, id, &Node::id);
  return found == nodes_.end() ? nullptr : &*found;
}

const Node* Tree::at(float x, float y) const {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (touchable(node) && node.rect.holds(x, y) && node.clip.holds(x, y) && !under_modal(i)) return &node;
  }
  return nullptr;
}

const Node* Tree::scroller_at(float x, float y) const {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    if (node.box.scroll && node.content_height > node.rect.h && node.rect.holds(x, y) && !under_modal(i))
      return &node;
  }
  return nullptr;
}

const Node* Tree::after(const Node* from, int direction) const {
  const auto count = int(nodes_.size());
  const int begin = from != nullptr ? int(from - nodes_.data()) : direction > 0 ? -1 : count;
  for (int step = 1; step <= count; ++step) {
    const auto i = std::size_t(((begin + direction * step) % count + count) % count);
    if (takes_focus(i) && !under_modal(i)) return &nodes_[i];
  }
  return nullptr;
}

const Node* Tree::question() const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].role == Role::Heading && !under_modal(i)) return &nodes_[i];
  }
  return nullptr;
}

const Node* Tree::beside(const Node& from, float right, float down) const {
  const auto middle = [](const Rect& r) { return std::pair(r.x + r.w / 2, r.y + r.h / 2); };
  const auto [x, y] = middle(from.rect);
  const Node* nearest = nullptr;
  float least = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (&node == &from || !takes_focus(i) || under_modal(i)) continue;
    const Rect& r = node.rect;
    const auto [to_x, to_y] = middle(r);
    if ((to_x - x) * right + (to_y - y) * down <= 1) continue;
    // How far apart the two are along the way and across it; what lies straight ahead comes first.
    const float gap_x = std::max({0.0F, r.x - from.rect.right(), from.rect.x - r.right()}),
                gap_y = std::max({0.0F, r.y - from.rect.bottom(), from.rect.y - r.bottom()});
    const float along = right != 0 ? gap_x : gap_y, across = right != 0 ? gap_y : gap_x;
    if (along <= 0 && across > 0) continue;
    const float off = right != 0 ? std::abs(to_y - y) : std::abs(to_x - x);
    const float cost = along + kAcross * across + kOff * off;
    if (nearest == nullptr || cost < least) nearest = &node, least = cost;
  }
  return nearest;
}

bool Tree::takes_focus(std::size_t index) const {
  const Node& node = nodes_[index];
  if (node.by_key.kind != ActionKind::None) return true;
  if (touchable(node)) return node.action.kind != ActionKind::TurnFace;
  return goes_on(node) && std::ranges::none_of(nodes_, [&](const Node& other) {
           return touchable(other) && scroller_around(other) == &node;
         });
}

const Node* Tree::scroller_around(const Node& node) const {
  for (std::int32_t at = node.parent; at >= 0; at = nodes_[std::size_t(at)].parent) {
    if (goes_on(nodes_[std::size_t(at)])) return &nodes_[std::size_t(at)];
  }
  return nullptr;
}

}  // namespace relievo::ui
