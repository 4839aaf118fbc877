// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/rig/svg_canvas.h"

#include <cstdio>

namespace relievo::bench {
namespace {

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", v);
  return text;
}

std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : words)
    out += c == '<'   ? std::string("&lt;")
           : c == '>' ? std::string("&gt;")
           : c == '&' ? std::string("&amp;")
                      : std::string(1, c);
  return out;
}

}  // namespace

SvgCanvas::SvgCanvas(double width, double height) {
  out_ =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      // In two pieces each: these lines are the drawing's, not this file's.
      "<!-- SPDX-"
      "FileCopyrightText: 2026 The Relievo authors -->\n"
      "<!-- SPDX-"
      "License-Identifier: GPL-3.0-or-later -->\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
      number(width) + "\" height=\"" + number(height) + "\" viewBox=\"0 0 " + number(width) + " " +
      number(height) + "\" font-family=\"DejaVu Sans, sans-serif\">\n" +
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
}

void SvgCanvas::line(SvgPoint from, SvgPoint to, const std::string& colour, double width) {
  out_ += "<line x1=\"" + number(from.first) + "\" y1=\"" + number(from.second) + "\" x2=\"" +
          number(to.first) + "\" y2=\"" + number(to.second) + "\" stroke=\"" + colour + "\" stroke-width=\"" +
          number(width) + "\"/>\n";
}

void SvgCanvas::path(const std::vector<SvgPoint>& points, const std::string& colour, double width,
                     const std::string& dash) {
  if (points.size() < 2) return;
  out_ += "<polyline fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + number(width) + "\"";
  if (!dash.empty()) out_ += " stroke-dasharray=\"" + dash + "\"";
  out_ += " points=\"";
  for (std::size_t i = 0; i < points.size(); ++i)
    out_ += (i > 0 ? " " : "") + number(points[i].first) + "," + number(points[i].second);
  out_ += "\"/>\n";
}

void SvgCanvas::dot(SvgPoint at, double radius, const std::string& colour) {
  out_ += "<circle cx=\"" + number(at.first) + "\" cy=\"" + number(at.second) + "\" r=\"" + number(radius) +
          "\" fill=\"" + colour + "\"/>\n";
}

void SvgCanvas::box(SvgPoint corner, double width, double height, const std::string& fill) {
  out_ += "<rect x=\"" + number(corner.first) + "\" y=\"" + number(corner.second) + "\" width=\"" +
          number(width) + "\" height=\"" + number(height) + "\" fill=\"" + fill + "\"/>\n";
}

void SvgCanvas::text(SvgPoint at, const std::string& words, double size, Anchor anchor, bool upwards,
                     bool bold) {
  const char* const anchors[] = {"start", "middle", "end"};
  out_ += "<text x=\"" + number(at.first) + "\" y=\"" + number(at.second) + "\" font-size=\"" + number(size) +
          "\" text-anchor=\"" + anchors[static_cast<int>(anchor)] + "\" fill=\"#222222\"";
  if (bold) out_ += " font-weight=\"bold\"";
  if (upwards) out_ += " transform=\"rotate(-90 " + number(at.first) + " " + number(at.second) + ")\"";
  out_ += ">" + escaped(words) + "</text>\n";
}

}  // namespace relievo::bench
