// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Node: one thing on the screen. A node has a stable id, by which focus, presses and scrolling are
// kept from one frame to the next, and a role and a name for tests and assistive use.
// Lengths are pixels: TreeBuilder has turned dp into them. Strings are borrowed from the tree or literals.
#pragma once

#include <cstdint>
#include <string_view>

#include "ui/draw/draw_list.h"
#include "ui/text/text_engine.h"
#include "ui/view/action.h"

namespace relievo::ui {

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
  bool secret = false;   // a person's own, spoken into headphones alone: its value, and words without a name
  bool waits = false;    // Alert: leaves time to do what another said before
  bool insists = false;  // an alert that is said again and again while it stands
  bool modal = false;    // nothing under it can be touched
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
  Rect rect;  // set by layout()
  Rect clip;
  float content_height = 0;  // of a scroller: what it would be high to show all, its own padding with it
};

}  // namespace relievo::ui
