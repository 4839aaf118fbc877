// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tree's picture and Tree's words: what a node looks like, and what it says of itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "ui/draw/theme.h"
#include "ui/tree/tree.h"

namespace relievo::ui {
namespace {

constexpr float kHeldBar = 10;  // dp
constexpr float kFade = 56;     // dp

// Holds until the next one is added.
Command& add(DrawList& list, Mark mark, const Rect& rect, const Rect& clip) {
  Command& command = list.commands.emplace_back();
  command.mark = mark;
  command.rect = rect;
  command.clip = clip;
  return command;
}

void paint_box(DrawList& list, const Node& node, bool touched, float unit) {
  const Box& box = node.box;
  if (box.shadow) {
    const Rect below{node.rect.x, node.rect.y + 5 * unit, node.rect.w, node.rect.h};
    Command& shadow = add(list, Mark::Shape, below, node.clip);
    shadow.fill = shadow.fill_end = {16, 32, 64, 46};
    shadow.radius = box.radius;
    shadow.blur_px = 11 * unit;
  }
  if (!box.fill.seen() && !box.border.seen()) return;
  const bool shaped = box.radius > 0 || box.border_px > 0;
  Command& c = add(list, shaped ? Mark::Shape : Mark::Flat, node.rect, node.clip);
  c.fill = touched ? pressed(box.fill) : box.fill;
  c.fill_end = touched || !box.fill_end.seen() ? c.fill : box.fill_end;
  c.border = box.border;
  c.border_px = box.border_px;
  c.radius = std::min(box.radius, std::min(node.rect.w, node.rect.h) / 2);
}

// A picture is seen whole, or fills its box and is cut at the sides.
void paint_picture(DrawList& list, const Node& node) {
  Command& c = add(list, node.mark, node.rect, node.clip);
  c.fill = node.colour.seen() ? node.colour : Colour{255, 255, 255, 255};
  c.border = node.box.border;
  c.border_px = node.line_px;
  c.radius = node.mark == Mark::Ring ? node.line_px / 2 : node.box.radius;
  c.share = node.mark == Mark::Face ? 1 - std::min(1.0F, node.covered_px / std::max(1.0F, node.rect.h))
                                    : node.share;
  c.picture = node.picture;
  c.face = node.face;
  if (node.mark == Mark::Ring) {
    c.fill = node.colour;
    c.border = node.box.fill;
    c.rect = node.clip;  // what lies outside is darkened, too
    c.uv = {node.rect.w / 2, node.rect.h / 2, 0, 0};
  }
  if (node.mark == Mark::Image && node.aspect > 0) {
    const float mine = node.rect.w / std::max(1.0F, node.rect.h);
    if (node.covers) {
      const float across = std::min(1.0F, mine / node.aspect), down = std::min(1.0F, node.aspect / mine);
      c.uv = {(1 - across) / 2, (1 - down) / 2, across, down};
    } else if (mine > node.aspect) {
      const float w = std::round(node.rect.h * node.aspect);
      c.rect.x += std::round((c.rect.w - w) / 2);
      c.rect.w = w;
    } else {
      const float h = std::round(node.rect.w / node.aspect);
      c.rect.y += std::round((c.rect.h - h) / 2);
      c.rect.h = h;
    }
    if (node.mirrored) c.uv = {c.uv.x + c.uv.w, c.uv.y, -c.uv.w, c.uv.h};
  }
}

void paint_text(DrawList& list, const Node& node, TextEngine& text, bool right_to_left) {
  const float pad_x = node.box.pad_x, pad_y = node.box.pad_y, room = std::max(1.0F, node.rect.w - 2 * pad_x);
  const TextSize size = text.measure(node.text, node.style, room);
  float x = 0;
  if (node.style.align == TextAlign::Centre) x = (room - size.width_px) / 2;
  else if (right_to_left != (node.style.align == TextAlign::End)) x = room - size.width_px;
  const float y = (node.rect.h - 2 * pad_y - size.height_px) / 2;
  // Whole pixels: pieces of a text meet without a seam.
  const float left = std::round(node.rect.x + pad_x + std::round(x)),
              top = std::round(node.rect.y + pad_y + std::round(y));
  const Rect all{-1e6F, -1e6F, 2e6F, 2e6F};  // a mirrored sign is small
  const Rect seen =
      node.mirrored ? all : Rect{node.clip.x - left, node.clip.y - top, node.clip.w, node.clip.h};
  for (const TextPiece& piece : text.pieces(node.text, node.style, room, seen)) {
    if (piece.atlas.w <= 0) continue;
    const Rect& ink = piece.ink;
    Command& c = add(list, Mark::Glyph, {left + ink.x, top + ink.y, ink.w, ink.h}, node.clip);
    c.uv = piece.atlas;
    if (node.mirrored) {
      c.rect.x = left + size.width_px - ink.x - ink.w;
      c.uv = {c.uv.x + c.uv.w, c.uv.y, -c.uv.w, c.uv.h};
    }
    c.fill = node.colour;
  }
}

void paint_focus(DrawList& list, const Node& node, Colour colour, float unit) {
  const float out = 5 * unit;
  const auto around = [](const Rect& r, float by) {
    return Rect{r.x - by, r.y - by, r.w + 2 * by, r.h + 2 * by};
  };
  Command& c = add(list, Mark::Shape, around(node.rect, out), around(node.clip, 2 * out));
  c.border = colour;
  c.border_px = size::kFocusRing * unit;
  c.radius = node.box.radius + out;
}

float scrolled_px(const Node& node, const Interaction& hands) {
  return hands.scrolled == node.id ? std::clamp(hands.scroll_px, 0.0F, node.content_height - node.rect.h) : 0;
}

// More lies below, or above: a bar at the side says where one is.
void paint_scroll_bar(DrawList& list, const Node& node, const Interaction& hands, bool right_to_left,
                      float unit) {
  if (!node.overflows()) return;
  const float scrolled = scrolled_px(node, hands);
  const float h = node.rect.h * node.rect.h / node.content_height,
              y = node.rect.y + node.rect.h * scrolled / node.content_height;
  const Rect bar{right_to_left ? node.rect.x - 12 * unit : node.rect.right() + 4 * unit, y, 8 * unit, h};
  Command& c = add(list, Mark::Shape, bar, {bar.x, node.rect.y, bar.w, node.rect.h});
  c.fill = c.fill_end = {120, 132, 156, 255};
  c.radius = 4 * unit;
}

// What is seen behind a node at a height: the nearest box around it that is filled.
Colour ground_of(const std::vector<Node>& nodes, std::size_t index, float y) {
  for (auto at = std::int32_t(index); at >= 0; at = nodes[std::size_t(at)].parent) {
    const Node& node = nodes[std::size_t(at)];
    if (!node.box.fill.seen()) continue;
    const Colour a = node.box.fill, b = node.box.fill_end.seen() ? node.box.fill_end : a;
    const float share = std::clamp((y - node.rect.y) / std::max(1.0F, node.rect.h), 0.0F, 1.0F);
    const auto between = [share](std::uint8_t from, std::uint8_t to) {
      return std::uint8_t(std::lround(std::lerp(float(from), float(to), share)));
    };
    return {between(a.r, b.r), between(a.g, b.g), between(a.b, b.b), between(a.a, b.a)};
  }
  return {};
}

// Where a scroller goes on, its content fades into the ground: no line ends torn, and one sees that there is
// more. The fade leaves as the end comes near, so that the last line is never veiled.
void paint_fades(DrawList& list, const std::vector<Node>& nodes, std::size_t index, const Interaction& hands,
                 float unit) {
  const Node& node = nodes[index];
  if (!node.overflows()) return;
  const float above = scrolled_px(node, hands), below = node.content_height - node.rect.h - above;
  const float h = std::round(std::min(kFade * unit, node.rect.h / 4)), edge = std::ceil(node.box.border_px);
  const float in = std::max(node.box.pad_x, edge);
  const auto fade = [&](float hidden, float y, float at_edge, bool down) {
    const Colour ground = ground_of(nodes, index, at_edge);
    if (hidden < 1 || !ground.seen()) return;
    const Colour shut = ground.with_alpha(std::min(1.0F, hidden / h)), open = ground.with_alpha(0);
    Command& c = add(list, Mark::Flat, {node.rect.x + in, y, node.rect.w - 2 * in, h}, node.clip);
    c.fill = down ? open : shut;
    c.fill_end = down ? shut : open;
  };
  fade(above, node.rect.y + edge, node.rect.y, false);
  fade(below, node.rect.bottom() - edge - h, node.rect.bottom(), true);
}

// How much of the time has passed: a bar along the bottom, in the direction of reading, within the node's
// round corners.
void paint_held(DrawList& list, const Node& node, float share, bool right_to_left, float unit) {
  const float h = std::min(node.rect.h, kHeldBar * unit), w = node.rect.w * share;
  Command& c = add(list, Mark::Shape, node.rect,
                   {right_to_left ? node.rect.right() - w : node.rect.x, node.rect.bottom() - h, w, h});
  c.radius = std::min(node.box.radius, std::min(node.rect.w, node.rect.h) / 2);
  c.fill = c.fill_end = node.filling;
}

// In the order of Role.
constexpr std::array<std::string_view, 10> kRoles{"group", "heading", "text",    "icon",   "button",
                                                  "key",   "field",   "picture", "status", "alert"};
static_assert(kRoles.size() == std::size_t(Role::Alert) + 1);

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) out += ' ';
    else out += c;
  }
  return out + '"';
}

}  // namespace

void Tree::paint(DrawList& list, TextEngine& text, const Interaction& hands, Colour focus, float unit) const {
  const Node* focused = nullptr;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const bool seen = node.clip.w > 0 && node.clip.h > 0;
    if (seen) paint_node(list, node, text, hands, unit);
    if (seen && hands.show_focus && !node.id.empty() && node.id == hands.focus) focused = &node;
    // Behind the last one in a scroller comes what lies over all of them.
    for (auto at = std::int32_t(i); node.first_child < 0 && at >= 0; at = nodes_[std::size_t(at)].parent) {
      paint_fades(list, nodes_, std::size_t(at), hands, unit);
      if (nodes_[std::size_t(at)].next >= 0) break;
    }
  }
  if (focused != nullptr) paint_focus(list, *focused, focus, unit);
}

void Tree::paint_node(DrawList& list, const Node& node, TextEngine& text, const Interaction& hands,
                      float unit) const {
  const bool pressed = !node.id.empty() && hands.pressed == node.id;
  if (node.mark == Mark::Shape) paint_box(list, node, pressed, unit);
  else paint_picture(list, node);
  paint_spots(list, node);
  if (pressed && node.hold && hands.held > 0) paint_held(list, node, hands.held, right_to_left_, unit);
  if (!node.text.empty()) paint_text(list, node, text, right_to_left_);
  paint_scroll_bar(list, node, hands, right_to_left_, unit);
}

void Tree::paint_spots(DrawList& list, const Node& node) const {
  for (std::uint32_t i = 0; i < node.spots; ++i) {
    const Spot& spot = spots_[node.first_spot + i];
    const float across = spot.place.w > 0 ? 0 : spot.thick_px, down = spot.place.h > 0 ? 0 : spot.thick_px;
    const Rect place{node.rect.x + spot.place.x * node.rect.w - across / 2,
                     node.rect.y + spot.place.y * node.rect.h - down / 2, spot.place.w * node.rect.w + across,
                     spot.place.h * node.rect.h + down};
    Command& c = add(list, spot.round ? Mark::Shape : Mark::Flat, place, node.clip);
    if (across > 0) c.rect.x = std::round(c.rect.x);  // a thin line between two pixels would be seen as none
    if (down > 0) c.rect.y = std::round(c.rect.y);
    c.fill = c.fill_end = spot.colour;
    if (spot.round) c.radius = std::min(c.rect.w, c.rect.h) / 2;
  }
}

std::string Tree::to_json() const {
  std::string out = "[";
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (under_modal(i) || (node.text.empty() && node.name.empty() && node.action.kind == ActionKind::None))
      continue;
    char place[96];
    std::snprintf(place, sizeof place, ",\"x\":%.0f,\"y\":%.0f,\"w\":%.0f,\"h\":%.0f}", node.rect.x,
                  node.rect.y, node.rect.w, node.rect.h);
    if (out.size() > 1) out += ",\n ";
    out += "{\"id\":" + quoted(node.id) + ",\"role\":" + quoted(kRoles[std::size_t(node.role)]) +
           ",\"name\":" + quoted(node.name.empty() ? node.text : node.name) +
           (node.value.empty() ? std::string() : ",\"value\":" + quoted(node.value)) + place;
  }
  return out + "]\n";
}

}  // namespace relievo::ui
