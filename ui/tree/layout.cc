// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/tree/tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/base/assert.h"

namespace relievo::ui {
namespace {

Rect meet(const Rect& a, const Rect& b) {
  const float x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0.0F, std::min(a.right(), b.right()) - x),
          std::max(0.0F, std::min(a.bottom(), b.bottom()) - y)};
}

// Words can be broken into more lines; a sign cannot.
constexpr float kLeastShare = 0.5F;  // of a row: so much of it belongs to the words, or all of what they need
constexpr float kEndless = 1e6F;
constexpr float kRounding = 1e-3F;     // of a pixel: thirds make a whole
constexpr float kWrappedGaps = 0.25F;  // what was a gap beside is a smaller one between lines

bool is_row(const Node& node) {
  return node.box.flow == Flow::Row && node.first_child >= 0 && node.box.grow <= 0;
}

float stretched_height(const Node& node, float h, float more) { return is_row(node) ? h + more : h; }

bool may_shrink(const Node& node) { return node.box.width <= 0 && !node.style.icon; }

// As large as fits, in the middle.
Rect fitted(const Rect& r, float aspect) {
  const float w = std::min(r.w, r.h * aspect), h = w / aspect;
  return {r.x + (r.w - w) / 2, r.y + (r.h - h) / 2, w, h};
}

Rect rounded(const Rect& r) { return {std::round(r.x), std::round(r.y), std::round(r.w), std::round(r.h)}; }

// Layout: gives every node its place. First what a box needs at a width, then where it goes:
// what is left over goes to those that grow; what is short is taken from rows' longest texts. A row that
// wraps (Box::wrap) is a column where its first child, in one line, would have less than kLeastShare beside
// the others. Pixels. Thread: main. Errors: none.
class Layout {
 public:
  Layout(std::vector<Node>& nodes, TextEngine& text, const Interaction& hands, bool right_to_left)
      : nodes_(nodes), text_(text), hands_(hands), right_to_left_(right_to_left) {}

  void place(std::size_t index, const Rect& rect, const Rect& clip) {
    Node& node = nodes_[index];
    node.rect = rounded(node.aspect > 0 && node.box.flow == Flow::Stack ? fitted(rect, node.aspect) : rect);
    node.clip = clip;
    const Rect inner{node.rect.x + node.box.pad_x, node.rect.y + node.box.pad_y,
                     std::max(0.0F, node.rect.w - 2 * node.box.pad_x),
                     std::max(0.0F, node.rect.h - 2 * node.box.pad_y)};
    const Rect inside = node.box.scroll ? meet(clip, node.rect) : clip;
    switch (node.box.flow) {
      case Flow::Column: return place_column(node, inner, inside);
      case Flow::Row:
        return wrapped(node, inner.w) ? place_column(node, inner, inside) : place_row(node, inner, inside);
      case Flow::Stack: return place_stack(node, inner, inside);
    }
  }

 private:
  struct Need {
    float w = 0, h = 0;
  };
  using Shares = std::array<float, kMostInARow>;  // widths

  Need need(const Node& node, float width) {
    const Box& box = node.box;
    float room = box.width > 0 ? box.width : width;
    if (box.max_width > 0) room = std::min(room, box.max_width);
    const float inner = std::max(1.0F, room - 2 * box.pad_x);
    Need n = content_need(node, inner);
    n.w += 2 * box.pad_x;
    n.h += 2 * box.pad_y;
    n.w = std::max(n.w, box.min_width);
    n.h = std::max(n.h, box.min_height);
    if (box.width > 0) n.w = box.width;
    if (box.height > 0) n.h = box.height;
    if (box.scroll && !box.shrink) n.h = std::max(box.min_height, box.height);
    return n;
  }

  Need content_need(const Node& node, float width) {
    if (!node.text.empty()) {
      const TextSize size =
          text_.measure(node.text, node.style, std::floor(width));  // as wide as it is placed
      return {size.width_px, size.height_px};
    }
    Need n;
    int count = 0;
    const bool is_wrapped = wrapped(node, width);
    if (node.box.flow == Flow::Row && !is_wrapped) {
      const Shares given = shares(node, width);
      for (std::int32_t at = node.first_child; at >= 0; at = nodes_[std::size_t(at)].next, ++count) {
        const Need child = need(nodes_[std::size_t(at)], given[std::size_t(count)]);
        n.w += child.w;
        n.h = std::max(n.h, child.h);
      }
      if (count > 1) n.w += node.box.gap * float(count - 1);
      return n;
    }
    for (std::int32_t at = node.first_child; at >= 0; at = nodes_[std::size_t(at)].next, ++count) {
      const Need child = need(nodes_[std::size_t(at)], width);
      n.w = std::max(n.w, child.w);
      n.h = node.box.flow == Flow::Stack ? std::max(n.h, child.h) : n.h + child.h;
    }
    if (node.box.flow != Flow::Stack && count > 1)
      n.h += node.box.gap * (is_wrapped ? kWrappedGaps : 1) * float(count - 1);
    return n;
  }

  // Would the words of its first child be broken into more lines beside what stands behind them?
  bool wrapped(const Node& row, float width) {
    if (!row.box.wrap || row.box.flow != Flow::Row || row.first_child < 0) return false;
    const Node& words = nodes_[std::size_t(row.first_child)];
    float left = width;
    for (std::int32_t at = words.next; at >= 0; at = nodes_[std::size_t(at)].next)
      left -= need(nodes_[std::size_t(at)], kEndless).w + row.box.gap;
    return left < kLeastShare * width && need(words, kEndless).w > left;
  }

  // How much higher than its content each row of a column is, where its rows may stretch and there is room.
  float row_stretch(const Node& column, const Rect& inner) {
    if (column.box.row_stretch <= 1) return 0;
    float rows = 0, lowest = inner.h, all = -column.box.gap;
    for (std::int32_t at = column.first_child; at >= 0; at = nodes_[std::size_t(at)].next) {
      const Node& child = nodes_[std::size_t(at)];
      const float h = need(child, inner.w).h;
      all += h + column.box.gap;
      if (is_row(child)) ++rows, lowest = std::min(lowest, h);
    }
    return rows > 0
               ? std::floor(std::clamp((inner.h - all) / rows, 0.0F, (column.box.row_stretch - 1) * lowest) +
                            kRounding)
               : 0;
  }

  // The widths of a row's children. Those that grow share what the others leave.
  Shares shares(const Node& row, float width) {
    Shares given{};
    std::size_t count = 0;
    float fixed = 0, grow = 0, soft = 0;
    for (std::int32_t at = row.first_child; at >= 0; at = nodes_[std::size_t(at)].next, ++count) {
      const Node& child = nodes_[std::size_t(at)];
      if (child.box.grow > 0) {
        grow += child.box.grow;
        continue;
      }
      given[count] = need(child, width).w;
      fixed += given[count];
      if (may_shrink(child)) soft += given[count];
    }
    const float gaps = count > 1 ? row.box.gap * float(count - 1) : 0;
    const float left = width - fixed - gaps;
    std::size_t i = 0;
    float before =
        0;  // of the shares: what is left is given out to the last pixel, so that rows end under each other
    for (std::int32_t at = row.first_child; at >= 0 && i < count; at = nodes_[std::size_t(at)].next, ++i) {
      const Node& child = nodes_[std::size_t(at)];
      if (child.box.grow > 0) {
        const float own = row.box.grid ? row.box.gap : 0,
                    all = std::max(0.0F, row.box.grid ? left + own * float(count) : left);
        const float from = std::floor(all * before / grow);
        before += child.box.grow;
        given[i] = std::max(0.0F, std::floor(all * before / grow + kRounding) - from - own);
      } else if (left < 0 && may_shrink(child) && soft > 0)
        given[i] = std::floor(given[i] + left * given[i] / soft);
    }
    return given;
  }

  float align_start(const Node& node, float room, float size) const {
    if (node.box.align == Align::End) return room - size;
    return node.box.align == Align::Centre ? (room - size) / 2 : 0;
  }

  void place_column(Node& node, const Rect& inner, const Rect& clip) {
    float fixed = 0, grow = 0, growing = 0, highest = 0,
          shown = 0;  // highest: a share of what those need that grow, were all shares as high
                      // shown: the height of a picture, when it alone grows
    int count = 0;
    const float taller = row_stretch(node, inner);
    for (std::int32_t at = node.first_child; at >= 0; at = nodes_[std::size_t(at)].next, ++count) {
      const Node& child = nodes_[std::size_t(at)];
      const float h = stretched_height(child, need(child, inner.w).h, taller);
      fixed += h;
      if (child.box.grow <= 0) continue;
      grow += child.box.grow, growing += h;
      shown = child.aspect > 0 && child.box.flow == Flow::Stack && grow == child.box.grow
                  ? inner.w / child.aspect
                  : 0;
      highest = std::max(highest, h / child.box.grow);
    }
    float gap = node.box.gap * (node.box.flow == Flow::Row ? kWrappedGaps : 1);
    if (count > 1) fixed += gap * float(count - 1);
    node.content_height = fixed + 2 * node.box.pad_y;
    if (node.box.fit_content && grow <= 0)
      node.rect.h = std::min(node.rect.h, std::round(node.content_height));
    float y = inner.y, over = node.box.scroll ? 0 : std::max(0.0F, fixed - inner.h);
    float left = std::max(0.0F, inner.h - fixed);
    if (node.box.scroll && fixed > inner.h && hands_.scrolled == node.id)
      y -= std::clamp(hands_.scroll_px, 0.0F, fixed - inner.h);
    const bool even = node.box.even && grow > 0 && highest * grow <= growing + left;
    if (grow <= 0 && node.box.justify == Justify::Centre) y += left / 2;
    if (shown > 0 && node.box.justify == Justify::Centre &&
        growing + left > shown) {  // what belongs to a picture stands beside it
      y += (growing + left - shown) / 2;
      left = std::max(0.0F, shown - growing);
    }
    if (grow <= 0 && node.box.justify == Justify::End) y += left;
    if (grow <= 0 && node.box.justify == Justify::SpaceBetween && count > 1) gap += left / float(count - 1);
    for (std::int32_t at = node.first_child; at >= 0; at = nodes_[std::size_t(at)].next) {
      const Node& child = nodes_[std::size_t(at)];
      Need n = need(child, inner.w);
      n.h = stretched_height(child, n.h, taller);
      if (child.box.shrink) n.h -= std::exchange(over, 0.0F);
      const float more = grow > 0 ? left * child.box.grow / grow : 0,
                  h = even && child.box.grow > 0 ? (growing + left) * child.box.grow / grow : n.h + more;
      const bool stretch = (node.box.align == Align::Stretch || node.box.flow == Flow::Row) &&
                           child.box.width <= 0 && child.box.max_width <= 0;
      const float w = stretch ? inner.w
                              : std::min(node.box.align == Align::Stretch && child.box.width <= 0
                                             ? std::min(inner.w, child.box.max_width)
                                             : n.w,
                                         inner.w);
      float x = align_start(node, inner.w, w);
      if (right_to_left_) x = inner.w - w - x;
      place(std::size_t(at), {inner.x + x, y, w, h}, clip);
      y += h + gap;
    }
  }

  void place_row(Node& node, const Rect& inner, const Rect& clip) {
    const Shares given = shares(node, inner.w);
    float used = 0;
    std::size_t count = 0;
    for (std::int32_t at = node.first_child; at >= 0; at = nodes_[std::size_t(at)].next)
      used += given[count++];
    float gap = node.box.gap;
    if (count > 1) used += gap * float(count - 1);
    const float left = std::max(0.0F, inner.w - used);
    float x = 0;
    if (node.box.justify == Justify::Centre) x = left / 2;
    if (node.box.justify == Justify::End) x = left;
    if (node.box.justify == Justify::SpaceBetween && count > 1) gap += left / float(count - 1);
    const bool mirrored = (right_to_left_ && !node.box.left_to_right) != node.box.other_side;
    std::size_t i = 0;
    for (std::int32_t at = node.first_child; at >= 0 && i < count; at = nodes_[std::size_t(at)].next, ++i) {
      const auto child = std::size_t(at);
      const float w = given[i];
      const float h =
          node.box.align == Align::Stretch ? inner.h : std::min(inner.h, need(nodes_[child], w).h);
      place(child,
            {inner.x + (mirrored ? inner.w - x - w : x), inner.y + align_start(node, inner.h, h), w, h},
            clip);
      x += w + gap;
    }
  }

  void place_stack(Node& node, const Rect& inner, const Rect& clip) {
    for (std::int32_t at = node.first_child; at >= 0; at = nodes_[std::size_t(at)].next) {
      const auto child = std::size_t(at);
      const Node& one = nodes_[child];
      if (!one.pinned) {
        place(child, inner, clip);
        continue;
      }
      const float w = one.box.width > 0 ? one.box.width : inner.w, h = one.box.height;
      place(child, {inner.x + one.pin_x * inner.w - w / 2, inner.y + one.pin_y * inner.h - h / 2, w, h},
            clip);
    }
  }

  std::vector<Node>& nodes_;
  TextEngine& text_;
  const Interaction& hands_;
  bool right_to_left_;
};

}  // namespace

void Tree::layout(const Rect& screen, TextEngine& text, const Interaction& hands) {
  RELIEVO_ASSERT(open_.empty() && !nodes_.empty());
  Layout(nodes_, text, hands, right_to_left_).place(0, screen, screen);
}

}  // namespace relievo::ui
