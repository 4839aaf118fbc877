// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tree: the nodes of one screen, in the order they are drawn. A screen fills it anew for every frame,
// in memory that stays; what must last (focus, press, scroll) is kept by node id in Interaction.
//
//   begin() -> open() ... close(), inside(), leaf() -> layout() -> paint(), at(), find()
//
// Pixels. Right-to-left: rows run the other way, nothing else changes. Thread: main. Errors: none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ui/draw/draw_list.h"
#include "ui/text/text_engine.h"
#include "ui/view/action.h"

namespace relievo::ui {

// Node: one thing on the screen. A node has a stable id, by which focus, presses and scrolling are
// kept from one frame to the next, and a role and a name for tests and assistive use.
// Lengths are pixels: Page has turned dp into them. Strings are borrowed from the tree or literals.

// A status is told when there is quiet, an alert at once.
enum class Role : std::uint8_t { Group, Heading, Text, Icon, Button, Key, Field, Picture, Status, Alert };
enum class Flow : std::uint8_t { Column, Row, Stack };
enum class Justify : std::uint8_t { Start, Centre, End, SpaceBetween };  // in the direction of the flow
enum class Align : std::uint8_t { Stretch, Start, Centre, End };         // at right angles to it

// In the words of CSS flexbox where it has one.
struct Box {
  Flow flow = Flow::Column;
  Justify justify = Justify::Start;
  Align align = Align::Stretch;
  float gap = 0;
  float pad_x = 0, pad_y = 0;
  float width = 0, height = 0;  // 0: as its content is
  float min_width = 0, min_height = 0, max_width = 0;
  float grow = 0;     // share of what is left over
  bool grid = false;  // a row of columns alike: a child that grows by n covers n of them and the gaps between
  bool even = false;  // a column whose growing children are as high as their shares, not higher by them
  bool scroll = false;    // a column that may be higher than its room
  bool shrink = false;    // in a column: as high as its content where there is room, else as high as is left
  float row_stretch = 1;  // a column: up to how many times higher its lowest row gets where there is room
  bool fit_content = false;    // a growing column that ends where its content does
  bool left_to_right = false;  // a row that is not mirrored: digits, keys
  bool other_side = false;     // a row whose ends are exchanged: its controls come to the other hand
  bool wrap = false;  // a row whose first child grows: the others stand under it where it would be narrow
  Colour fill{}, fill_end{}, border{};  // fill_end not seen: plain fill
  float border_px = 0, radius = 0;
  bool shadow = false;
};

// A rectangle that is drawn on a node: shares of the node's. A line has no width or no height, but
// `thick_px`.
struct Spot {
  Rect place;
  Colour colour;
  float thick_px = 0;
  bool round = false;
};

struct Node {
  std::string_view id;
  std::string_view name;   // spoken; empty: the text
  std::string_view value;  // spoken after the name: where a gauge stands, what is in a field
  std::string_view text;
  Role role = Role::Group;
  Box box;
  TextStyle style;
  Colour colour{};
  Action action{};
  Action by_key{};  // done by a keypad that presses it where a finger does nothing or something else: it can
                    // have the focus
  bool secret = false;    // a person's own, spoken into headphones alone: its value, and words without a name
  bool unspoken = false;  // said elsewhere, or not yet
  bool waits = false;     // Alert: leaves time to do what another said before
  bool insists = false;   // an alert that is said again and again while it stands
  bool modal = false;     // nothing under it can be touched
  // Where it is set, `action` is done when a finger comes down, and this wherever it goes from there.
  Action dragged{};
  bool hold = false;        // done by a finger that rests (ui/view/service.h: kHold), not by a tap
  bool slow_key = false;    // of such a one: a keypad waits as long, and any further key calls it back
  Colour filling{};         // of the bar that says how long one still has to hold
  Mark mark = Mark::Shape;  // Image, Face, Ring: what is drawn in the rect
  PictureSlot picture = PictureSlot::None;
  std::uint8_t face = 0;  // of a Face: which of the models
  bool ruled = false;     // of a Face: Service::ruler lies on it
  float aspect = 0;       // of the picture: width over height; a stack with one is as large as fits
  bool pinned = false;    // in a stack: its middle lies at these shares of it; without a width it is as wide
  float pin_x = 0, pin_y = 0;
  bool mirrored = false;  // the picture or the sign, as in a mirror
  bool covers = false;    // the picture fills its box and is cut; else it is seen whole
  float share = 1, line_px = 0;
  float covered_px = 0;  // of a Face, at its lower end: the model stands in the middle of the rest
  std::uint32_t first_spot = 0, spots = 0;  // of the tree's
  std::int32_t parent = -1, first_child = -1, last_child = -1, next = -1;
  std::uint32_t children = 0;
  Rect rect;  // set by layout()
  Rect clip;
  float content_height = 0;  // of a scroller: what it would be high to show all, its own padding with it
  bool overflows() const { return box.scroll && content_height > rect.h + 1; }
};

// What is remembered of the person's hands.
struct Interaction {
  std::string focus;        // id; empty: none
  bool show_focus = false;  // the keypad was used last
  std::string pressed;
  float held = 0;        // of the time for which what is pressed has to be held
  std::string scrolled;  // the scroller whose place is `scroll_px`
  float scroll_px = 0;
};

inline constexpr std::size_t kMostInARow = 16;

class Tree {
 public:
  Tree();
  void begin(bool right_to_left);
  // Adds a node as the last child of the open one (of a row no more than kMostInARow); strings must outlive
  // the frame: keep() copies.
  Node& open(const Node& node);
  // The innermost ones, so many.
  void close(int levels = 1) { open_.resize(open_.size() - std::size_t(levels)); }
  // Opens it until the end of the block.
  class Inside {
   public:
    explicit Inside(Tree& tree) : tree_(tree) {}
    ~Inside() { tree_.close(); }
    Inside& operator=(Inside&&) = delete;

   private:
    Tree& tree_;
  };
  [[nodiscard]] Inside inside(const Node& node) { return open(node), Inside(*this); }
  Node& leaf(const Node& node);
  std::string_view keep(std::string_view text);
  // All that was kept since it was so much, as one text.
  std::size_t kept() const { return strings_used_; }
  std::string_view kept_since(std::size_t from) const {
    return {strings_.data() + from, strings_used_ - from};
  }
  // On the newest node, over what was drawn on it before.
  void mark(const Spot& spot);

  void layout(const Rect& screen, TextEngine& text, const Interaction& hands);
  void paint(DrawList& list, TextEngine& text, const Interaction& hands, Colour focus, float unit) const;

  const std::vector<Node>& nodes() const { return nodes_; }
  const Node* find(std::string_view id) const;
  // What lies over the page, else the page; what is in it can be touched and is read.
  const Node& top() const { return nodes_[modal_ < 0 ? 0 : std::size_t(modal_)]; }
  bool is_on_top(const Node& node) const { return !under_modal(std::size_t(&node - nodes_.data())); }
  // The topmost node there that can be touched; the scroller there.
  const Node* at(float x, float y) const;
  const Node* scroller_at(float x, float y) const;
  // The next in reading order (that of the nodes) that can have the focus, round and round, nullptr: from
  // where they begin or end: what can be touched, and a scroller that goes on and has nothing to touch in
  // it, so that a keypad reads on there, too.
  const Node* after(const Node* from, int direction) const;
  // The next that can have the focus as the eye sees it: one of `right` and `down` is 1 or -1. nullptr: none.
  const Node* beside(const Node& from, float right, float down) const;
  // The heading of what lies on top: what is asked comes after it. nullptr: it has none.
  const Node* question() const;
  // The scroller that goes on and holds the node; nullptr: none.
  const Node* scroller_around(const Node& node) const;
  // [{"id", "role", "name", "value", "x", "y", "w", "h"}, ...] of everything that speaks or can be touched.
  std::string to_json() const;

 private:
  bool under_modal(std::size_t index) const;
  bool takes_focus(std::size_t index) const;
  void paint_node(DrawList& list, const Node& node, TextEngine& text, const Interaction& hands,
                  float unit) const;
  void paint_spots(DrawList& list, const Node& node) const;

  std::vector<Node> nodes_;
  std::vector<Spot> spots_;
  std::vector<std::int32_t> open_;
  std::vector<char> strings_;
  std::size_t strings_used_ = 0;
  bool right_to_left_ = false;
  std::int32_t modal_ = -1;
};

}  // namespace relievo::ui
