// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/rig/sweep_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <map>

#include "tests/bench/rig/svg_canvas.h"

namespace relievo::bench {
namespace {

constexpr double kWidth = 460, kHeight = 340;  // of a panel
constexpr double kLeft = 62, kRight = 16, kTop = 34, kBottom = 50;
const char* const kPortraitColour = "#0b5fa5";
const char* const kLandscapeColour = "#c4501b";
const char* const kGrey = "#d8d8d8";

std::string label_of(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", std::round(v * 1000) / 1000);
  return text;
}

struct Axis {
  std::string label;
  double low = 0, high = 1, step = 0.2;
  double at(double v, double from, double to) const {
    return from + (std::clamp(v, low, high) - low) / (high - low) * (to - from);
  }
};

using Value = std::function<double(const Row&)>;
struct Series {
  std::string name, colour, dash;
  std::function<bool(const Row&)> which;
  Value y;
};

struct Panel {
  std::string title;
  Axis x, y;
  Value along;
  std::vector<Series> series;
  bool legend_below = true;
};

class Frame {
 public:
  Frame(SvgCanvas& canvas, SvgPoint corner, const std::string& title, const Axis& x, const Axis& y)
      : canvas_(canvas),
        x_(x),
        y_(y),
        left_(corner.first + kLeft),
        right_(corner.first + kWidth - kRight),
        top_(corner.second + kTop),
        bottom_(corner.second + kHeight - kBottom) {
    canvas_.text({(left_ + right_) / 2, corner.second + 20}, title, 14, SvgCanvas::Anchor::Middle, false,
                 true);
  }
  SvgPoint at(double x, double y) const { return {x_.at(x, left_, right_), y_.at(y, bottom_, top_)}; }

  void grid() {
    for (double v = x_.low; v < x_.high + x_.step / 2; v += x_.step) {
      canvas_.line(at(v, y_.low), at(v, y_.high), kGrey);
      canvas_.text({at(v, y_.low).first, bottom_ + 16}, label_of(v), 11, SvgCanvas::Anchor::Middle);
    }
    for (double v = y_.low; v < y_.high + y_.step / 2; v += y_.step) {
      canvas_.line(at(x_.low, v), at(x_.high, v), kGrey);
      canvas_.text({left_ - 6, at(x_.low, v).second + 4}, label_of(v), 11, SvgCanvas::Anchor::End);
    }
    canvas_.text({(left_ + right_) / 2, bottom_ + 36}, x_.label, 12, SvgCanvas::Anchor::Middle);
    canvas_.text({left_ - 44, (top_ + bottom_) / 2}, y_.label, 12, SvgCanvas::Anchor::Middle, true);
  }
  void outline() {
    canvas_.path({{left_, top_}, {right_, top_}, {right_, bottom_}, {left_, bottom_}, {left_, top_}},
                 "#222222", 1);
  }
  double left() const { return left_; }
  double top() const { return top_; }
  double bottom() const { return bottom_; }

 private:
  SvgCanvas& canvas_;
  Axis x_, y_;
  double left_, right_, top_, bottom_;
};

// Means over the people; each person's own value stays as a small dot.
void draw_lines(SvgCanvas& canvas, SvgPoint corner, const Panel& panel, const std::vector<Row>& rows) {
  Frame frame(canvas, corner, panel.title, panel.x, panel.y);
  frame.grid();
  std::vector<Series> drawn;
  for (const Series& series : panel.series)
    if (std::any_of(rows.begin(), rows.end(), series.which)) drawn.push_back(series);
  // Shares leave the foot of their panel free, errors the head.
  double legend =
      panel.legend_below ? frame.bottom() - 15.0 * static_cast<double>(drawn.size()) + 6 : frame.top() + 16;
  for (const Series& series : drawn) {
    std::map<double, std::pair<double, int>> sums;
    for (const Row& row : rows) {
      if (!series.which(row) || !std::isfinite(series.y(row))) continue;
      auto& sum = sums[panel.along(row)];
      sum.first += series.y(row);
      ++sum.second;
      canvas.dot(frame.at(panel.along(row), series.y(row)), 1.6, series.colour);
    }
    std::vector<SvgPoint> points;
    for (const auto& [x, sum] : sums) points.push_back(frame.at(x, sum.first / sum.second));
    canvas.path(points, series.colour, 2.2, series.dash);
    canvas.path({{frame.left() + 10, legend - 4}, {frame.left() + 36, legend - 4}}, series.colour, 2.2,
                series.dash);
    canvas.text({frame.left() + 41, legend}, series.name, 11);
    legend += 15;
  }
  frame.outline();
}

// How much of the face both see at a place, in steps of a fifth; green from kWhole on.
constexpr double kWhole = 0.95;
std::string fill_of(double share) {
  if (share >= kWhole) return "#dcefcf";
  const double step = std::clamp(std::floor(5 * share) / 5, 0.0, 0.8);
  const auto level = static_cast<int>(std::lround(70 + 190 * step));
  char fill[16];
  std::snprintf(fill, sizeof fill, "#%02x%02x%02x", level * 3 / 4, level * 7 / 8, level);
  return fill;
}

void draw_volume(SvgCanvas& canvas, SvgPoint corner, const std::string& title, const std::string& sideways,
                 const Value& side, const std::vector<Row>& rows,
                 const std::function<bool(const Row&)>& which) {
  const Axis x{"face to the middle between the cameras, mm", 400, 760, 40}, y{sideways, -280, 280, 40};
  Frame frame(canvas, corner, title, x, y);
  const double cell_width = frame.at(420, 0).first - frame.at(400, 0).first;
  const double cell_height = std::abs(frame.at(400, 20).second - frame.at(400, 0).second);
  frame.grid();
  std::map<double, std::map<double, std::string>> columns;
  for (const Row& row : rows)
    if (which(row))
      columns[row.rig.distance_mm + row.stand.back_mm][side(row)] = fill_of(row.result.seen_by_both);
  // Neighbours of one colour are one box: the file stays small.
  for (const auto& [along, cells] : columns)
    for (auto first = cells.begin(); first != cells.end();) {
      auto last = first;
      while (std::next(last) != cells.end() && std::next(last)->second == first->second) ++last;
      const SvgPoint low = frame.at(along, first->first), high = frame.at(along, last->first);
      canvas.box({low.first - cell_width / 2, high.second - cell_height / 2}, cell_width + 0.3,
                 low.second - high.second + cell_height, first->second);
      first = std::next(last);
    }
  frame.outline();
}

bool portrait(const Row& row) { return row.rig.portrait; }

Series make(const char* name, const char* colour, const char* dash, const std::string& panel, bool upright,
            Value y) {
  return {
      name, colour, dash,
      [panel, upright](const Row& r) { return r.panel == panel && portrait(r) == upright && r.result.done; },
      std::move(y)};
}

double within(const Row& r) { return 100 * r.result.within_half_mm; }
double both(const Row& r) { return 100 * r.result.seen_by_both; }
double matched(const Row& r) { return 100 * r.result.matched; }
double median(const Row& r) { return r.result.median_mm; }
double p95(const Row& r) { return r.result.p95_mm; }

const Axis kShare{"share of the face, %", 0, 100, 20};
const Axis kError{"error, mm", 0, 1.2, 0.2};

std::vector<Series> shares(const std::string& panel) {
  return {make("right to 0.5 mm, portrait", kPortraitColour, "", panel, true, within),
          make("right to 0.5 mm, landscape", kLandscapeColour, "", panel, false, within),
          make("seen by both, portrait", kPortraitColour, "6 4", panel, true, both),
          make("seen by both, landscape", kLandscapeColour, "6 4", panel, false, both),
          make("matched, of what both see, portrait", kPortraitColour, "2 3", panel, true, matched)};
}

std::vector<Series> errors(const std::string& panel) {
  return {make("median, portrait", kPortraitColour, "", panel, true, median),
          make("median, landscape", kLandscapeColour, "", panel, false, median),
          make("95 %, portrait", kPortraitColour, "6 4", panel, true, p95),
          make("95 %, landscape", kLandscapeColour, "6 4", panel, false, p95)};
}

std::vector<Panel> panels() {
  const Axis baseline{"baseline, mm (560 mm, 2320 px)", 40, 260, 20},
      focal{"focal length, px (560 mm, 110 mm)", 1200, 4000, 400};
  const Axis distance{"distance, mm (field of view and triangle kept)", 400, 880, 80},
      toe{"toe-in: 0 parallel, 1 axes meet at the face", 0, 2, 0.5};
  const Axis tilt{"pitch of the face against the cameras, degrees", -40, 40, 10};
  const auto b = [](const Row& r) { return r.rig.baseline_mm; };
  const auto f = [](const Row& r) { return r.rig.focal_px; };
  const auto d = [](const Row& r) { return r.rig.distance_mm; };
  const auto t = [](const Row& r) { return r.rig.toe_in; };
  const auto p = [](const Row& r) { return r.stand.pitch_deg; };
  return {{"Baseline: how much of the face", baseline, kShare, b, shares("baseline")},
          {"Baseline: how well", baseline, kError, b, errors("baseline"), false},
          {"Focal length: how much of the face", focal, kShare, f, shares("focal")},
          {"Focal length: how well", focal, kError, f, errors("focal"), false},
          {"Distance: how much of the face", distance, kShare, d, shares("distance")},
          {"Distance: how well", distance, kError, d, errors("distance"), false},
          {"Toe-in: how much of the face", toe, kShare, t, shares("toe-in")},
          {"Tilt: how much of the face", tilt, kShare, p, shares("tilt")}};
}

}  // namespace

std::string draw_sweep(const std::vector<Row>& rows) {
  constexpr int kColumns = 3;
  const double top = 34;
  SvgCanvas canvas(kColumns * kWidth, 4 * kHeight + top);
  canvas.text({16, 22},
              "Simulated people before simulated rigs, the whole chain behind them, calibrated by the rig's "
              "truth. Lines: means, dots: persons. Below, green: both cameras see 95 % of the face or more; "
              "the darker, the less.",
              13);
  int place = 0;
  const auto corner = [&] {
    const SvgPoint at{place % kColumns * kWidth, top + place / kColumns * kHeight};
    ++place;
    return at;
  };
  for (const Panel& panel : panels()) draw_lines(canvas, corner(), panel, rows);
  for (const bool upright : {true, false}) {
    const std::string name = upright ? "portrait" : "landscape";
    draw_volume(
        canvas, corner(), "Where both cameras see the face: " + name + ", height", "face below the axis, mm",
        [](const Row& r) { return r.stand.down_mm; }, rows,
        [upright](const Row& r) { return r.panel == "volume-height" && portrait(r) == upright; });
    draw_volume(
        canvas, corner(), "Where both cameras see the face: " + name + ", side", "face beside the axis, mm",
        [](const Row& r) { return r.stand.right_mm; }, rows,
        [upright](const Row& r) { return r.panel == "volume-width" && portrait(r) == upright; });
  }
  return canvas.finish();
}

}  // namespace relievo::bench
