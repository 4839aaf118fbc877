// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SvgCanvas: a handful of shapes as plain SVG 1.1. Pixels, y down. Text is escaped.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace relievo::bench {

using SvgPoint = std::pair<double, double>;

class SvgCanvas {
 public:
  SvgCanvas(double width, double height);
  void line(SvgPoint from, SvgPoint to, const std::string& colour, double width = 1);
  void path(const std::vector<SvgPoint>& points, const std::string& colour, double width,
            const std::string& dash = "");
  void dot(SvgPoint at, double radius, const std::string& colour);
  void box(SvgPoint corner, double width, double height, const std::string& fill);
  enum class Anchor { Start, Middle, End };
  void text(SvgPoint at, const std::string& words, double size, Anchor anchor = Anchor::Start,
            bool upwards = false, bool bold = false);
  std::string finish() const { return out_ + "</svg>\n"; }

 private:
  std::string out_;
};

}  // namespace relievo::bench
