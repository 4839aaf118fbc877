// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Layout: gives every node its place. First what a box needs at a width, then where it goes:
// what is left over goes to those that grow; what is short is taken from rows' longest texts. A row that
// wraps (Box::wrap) is a column where its first child, in one line, would have less than kLeastShare beside
// the others. Pixels. Thread: main. Errors: none.
#pragma once

#include <vector>

#include "ui/tree/tree.h"

namespace relievo::ui {

class Layout {
 public:
  Layout(std::vector<Node>& nodes, TextEngine& text, const Interaction& hands, bool right_to_left)
      : nodes_(nodes), text_(text), hands_(hands), right_to_left_(right_to_left) {}
  void place(std::size_t index, const Rect& rect, const Rect& clip);

 private:
  struct Need {
    float w = 0, h = 0;
  };
  static constexpr std::size_t kMostInARow = 16;
  struct Shares {
    std::array<float, kMostInARow> w{};
  };
  Need need(const Node& node, float width);
  Need content_need(const Node& node, float width);
  Shares shares(const Node& row, float width);
  bool wrapped(const Node& row, float width);
  float row_stretch(const Node& column, const Rect& inner);
  void place_column(Node& node, const Rect& inner, const Rect& clip);
  void place_row(Node& node, const Rect& inner, const Rect& clip);
  void place_stack(Node& node, const Rect& inner, const Rect& clip);
  float align_start(const Node& node, float room, float size) const;

  std::vector<Node>& nodes_;
  TextEngine& text_;
  const Interaction& hands_;
  bool right_to_left_;
};

}  // namespace relievo::ui
