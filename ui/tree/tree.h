// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tree: the nodes of one screen, in the order they are drawn. A screen fills it anew for every frame,
// in memory that stays; what must last (focus, press, scroll) is kept by node id in Interaction.
//
//   begin() -> open() ... close(), leaf() -> layout() -> paint(), at(), find()
//
// Pixels. Right-to-left: rows run the other way, nothing else changes. Thread: main. Errors: none.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ui/tree/node.h"

namespace relievo::ui {

// What is remembered of the person's hands.
struct Interaction {
  std::string focus;        // id; empty: none
  bool show_focus = false;  // the keypad was used last
  std::string pressed;
  float held = 0;        // of the time for which what is pressed has to be held
  std::string scrolled;  // the scroller whose place is `scroll_px`
  float scroll_px = 0;
};

class Tree {
 public:
  Tree();
  void begin(bool right_to_left);
  // Adds a node as the last child of the open one; strings must outlive the frame: keep() copies.
  Node& open(const Node& node);
  void close();
  Node& leaf(const Node& node);
  std::string_view keep(std::string_view text);
  // On the newest node, over what was drawn on it before.
  void mark(const Spot& spot);

  void layout(const Rect& screen, TextEngine& text, const Interaction& hands);
  void paint(DrawList& list, TextEngine& text, const Interaction& hands, Colour focus, float unit) const;

  const std::vector<Node>& nodes() const { return nodes_; }
  const Node* find(std::string_view id) const;
  // What lies over the page, else the page; what is in it can be touched and is read.
  const Node& top() const { return nodes_[modal_ < 0 ? 0 : static_cast<std::size_t>(modal_)]; }
  bool is_on_top(const Node& node) const {
    return !under_modal(static_cast<std::size_t>(&node - nodes_.data()));
  }
  // The topmost node there that can be touched; the scroller there.
  const Node* at(float x, float y) const;
  const Node* scroller_at(float x, float y) const;
  // The next in reading order (that of the nodes) that can have the focus, round and round: what can be
  // touched, and a scroller that goes on and has nothing to touch in it, so that a keypad reads on there,
  // too.
  const Node* after(std::string_view id, int direction) const;
  // The next that can have the focus as the eye sees it: one of `right` and `down` is 1 or -1. nullptr: none.
  const Node* beside(const Node& from, float right, float down) const;
  // The heading of what lies on top: what is asked comes after it. nullptr: it has none.
  const Node* question() const;
  // The scroller that goes on and holds the node; nullptr: none.
  const Node* scroller_around(const Node& node) const;
  bool right_to_left() const { return right_to_left_; }
  // [{"id", "role", "name", "value", "x", "y", "w", "h"}, ...] of everything that speaks or can be touched.
  std::string to_json() const;

 private:
  bool under_modal(std::size_t index) const;
  bool takes_focus(std::size_t index) const;
  void paint_node(DrawList& list, const Node& node, TextEngine& text, const Interaction& hands,
                  float unit) const;
  void paint_spots(DrawList& list, const Node& node) const;
  static bool touches(const Interaction& hands, const Node& node);

  std::vector<Node> nodes_;
  std::vector<Spot> spots_;
  std::vector<std::int32_t> open_;
  std::vector<char> strings_;
  std::size_t strings_used_ = 0;
  bool right_to_left_ = false;
  std::int32_t modal_ = -1;
};

}  // namespace relievo::ui
