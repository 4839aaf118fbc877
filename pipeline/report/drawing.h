// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture made of lines, as SVG that stands in the page: its styles are classes of page.cc.
// Axes as on paper: x right, y down. Thread: any.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline::report {

struct Size {
  double width = 0;
  double height = 0;
};

struct Box {
  Vec2d corner;  // top left
  Size size;

  double right() const { return corner.x + size.width; }
  double bottom() const { return corner.y + size.height; }
};

// Many strokes as one element: thousands of corners are drawn with it.
class Strokes {
 public:
  Strokes& from(Vec2d at) { return add("M", at); }
  Strokes& to(Vec2d at) { return add("L", at); }
  Strokes& dot(Vec2d at) { return add("M", at, "h0"); }  // as wide as the stroke, where its ends are round
  Strokes& outline(std::span<const Vec2d> polygon);
  bool empty() const { return d_.empty(); }
  const std::string& text() const { return d_; }

 private:
  Strokes& add(std::string_view command, Vec2d at, std::string_view after = {});
  std::string d_;
};

class Drawing {
 public:
  // `says` stands for it where it cannot be seen.
  Drawing(Size size, std::string_view says);

  void line(std::string_view style, Vec2d a, Vec2d b);
  void box(std::string_view style, const Box& box);
  void filled(const Box& box, std::string_view colour);  // "#rrggbb"
  void disc(std::string_view style, Vec2d middle, double radius);
  void strokes(std::string_view style, const Strokes& strokes);
  // style: begin, middle or end of the text stands at the place, by class.
  void text(std::string_view style, Vec2d at, std::string_view words);
  void picture(const Box& box, std::span<const std::byte> file);  // JPEG or PNG
  std::string svg() const;

 private:
  std::string body_;
};

// A scale from values to a drawing's coordinates.
struct Axis {
  double low = 0, high = 1;   // values
  double begin = 0, end = 1;  // where they are drawn

  double operator()(double value) const { return begin + (value - low) / (high - low) * (end - begin); }
};

// 1, 2 or 5 times a power of ten: the least that is not below `value`, the greatest that is not above it.
double rounded_up(double value);
double rounded_down(double value);

// A step of that kind that divides `range` into at most `parts`, and the decimals its multiples need.
double tick_step(double range, int parts);
int tick_decimals(double step);

// The smallest convex polygon around the points (Andrew's monotone chain).
std::vector<Vec2d> hull(std::vector<Vec2d> points);

}  // namespace relievo::pipeline::report
