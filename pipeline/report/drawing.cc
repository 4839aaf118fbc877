// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "pipeline/report/page.h"

namespace relievo::pipeline::report {
namespace {

std::string attribute(std::string_view name, double value) {
  return " " + std::string(name) + "=\"" + number(value, 2) + "\"";
}

std::string of_class(std::string_view style) { return " class=\"" + std::string(style) + "\""; }

std::string place(const Box& box) {
  return attribute("x", box.corner.x) + attribute("y", box.corner.y) + attribute("width", box.size.width) +
         attribute("height", box.size.height);
}

double kind_of_step(double value, bool up) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double ten = std::pow(10.0, std::floor(std::log10(value)));
  const double steps[] = {1, 2, 5, 10};
  constexpr double kSlack = 1e-9;  // 0.2 is 0.2, whatever its last bit says
  if (up) {
    for (const double step : steps)
      if (step * ten >= value * (1 - kSlack)) return step * ten;
    return 10 * ten;
  }
  double best = ten;
  for (const double step : steps)
    if (step * ten <= value * (1 + kSlack)) best = step * ten;
  return best;
}

}  // namespace

Strokes& Strokes::add(std::string_view command, Vec2d at, std::string_view after) {
  d_.append(command).append(number(at.x) + " " + number(at.y)).append(after);
  return *this;
}
Strokes& Strokes::outline(std::span<const Vec2d> polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) i == 0 ? from(polygon[i]) : to(polygon[i]);
  if (!polygon.empty()) d_ += 'Z';
  return *this;
}

Drawing::Drawing(Size size, std::string_view says)
    : body_("<svg viewBox=\"0 0 " + number(size.width) + " " + number(size.height) +
            "\" role=\"img\" aria-label=\"" + escaped(says) + "\">\n") {}

void Drawing::line(std::string_view style, Vec2d a, Vec2d b) {
  body_ += "<line" + of_class(style) + attribute("x1", a.x) + attribute("y1", a.y) + attribute("x2", b.x) +
           attribute("y2", b.y) + "/>\n";
}

void Drawing::box(std::string_view style, const Box& box) {
  body_ += "<rect" + of_class(style) + place(box) + "/>\n";
}

void Drawing::filled(const Box& box, std::string_view colour) {
  body_ += "<rect" + place(box) + " fill=\"" + std::string(colour) + "\"/>\n";
}

void Drawing::disc(std::string_view style, Vec2d middle, double radius) {
  body_ += "<circle" + of_class(style) + attribute("cx", middle.x) + attribute("cy", middle.y) +
           attribute("r", radius) + "/>\n";
}

void Drawing::strokes(std::string_view style, const Strokes& strokes) {
  if (!strokes.empty()) body_ += "<path" + of_class(style) + " d=\"" + strokes.text() + "\"/>\n";
}

void Drawing::text(std::string_view style, Vec2d at, std::string_view words) {
  body_ += "<text" + of_class(style) + attribute("x", at.x) + attribute("y", at.y) + ">" + escaped(words) +
           "</text>\n";
}

void Drawing::picture(const Box& box, std::span<const std::byte> file) {
  const bool png = !file.empty() && file.front() == std::byte{0x89};
  body_ += "<image" + place(box) + " preserveAspectRatio=\"xMidYMid meet\" href=\"data:image/" +
           (png ? "png" : "jpeg") + ";base64," + base64(file) + "\"/>\n";
}

std::string Drawing::svg() const { return body_ + "</svg>\n"; }

double rounded_up(double value) { return kind_of_step(value, true); }
double rounded_down(double value) { return kind_of_step(value, false); }

double tick_step(double range, int parts) { return rounded_up(range / parts); }

int tick_decimals(double step) { return std::max(0, -int(std::floor(std::log10(step) + 1e-9))); }

std::vector<Vec2d> hull(std::vector<Vec2d> points) {
  std::ranges::sort(points,
                    [](const Vec2d& a, const Vec2d& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto turn = [](const Vec2d& o, const Vec2d& a, const Vec2d& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  };
  std::vector<Vec2d> around;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = around.size();
    for (const Vec2d& p : points) {
      while (around.size() >= begin + 2 && turn(around[around.size() - 2], around.back(), p) <= 0)
        around.pop_back();
      around.push_back(p);
    }
    if (!around.empty()) around.pop_back();  // begins the other half
    std::ranges::reverse(points);
  }
  return around;
}

}  // namespace relievo::pipeline::report
