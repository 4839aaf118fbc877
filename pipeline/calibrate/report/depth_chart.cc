// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

constexpr Size kDepthSize{480, 440};
constexpr Box kDepthPlot{{58, 56}, {408, 334}};

void axes(Drawing& d, const Axis& x, const Axis& y) {
  const double step = tick_step(y.high, 5);
  const int decimals = tick_decimals(step);
  for (int k = 0; k * step <= y.high + 0.01 * step; ++k) {
    const double value = k * step;
    d.line(value == 0 ? "axis" : "grid", {kDepthPlot.corner.x, y(value)}, {kDepthPlot.right(), y(value)});
    d.text("tick end", {kDepthPlot.corner.x - 8, y(value) + 4.5}, figure(value, decimals));
  }
  for (int i = 0; i < kDepthSteps; ++i) {
    const double mm = kFirstDepthMm + i * kDepthStepMm;
    d.line("axis", {x(mm), kDepthPlot.bottom()}, {x(mm), kDepthPlot.bottom() + 5});
    d.text("tick middle", {x(mm), kDepthPlot.bottom() + 20}, figure(mm, 0));
  }
  d.text("label middle", {0.5 * (kDepthPlot.corner.x + kDepthPlot.right()), kDepthSize.height - 8},
         "distance from the left camera, mm");
  d.text("label begin", {4, 16}, "depth uncertainty, one sigma, mm");
}

// Where boards were held: beyond, the calibration is a continuation.
void held(Drawing& d, const Axis& x, const CalibrationQuality& q) {
  double nearest = x.high;
  double farthest = x.low;
  for (const ViewQuality& view : q.views) {
    if (!view.used) continue;
    nearest = std::min(nearest, std::max(view.distance_mm, x.low));
    farthest = std::max(farthest, std::min(view.distance_mm, x.high));
  }
  if (nearest < farthest)
    d.box("held", {{x(nearest), kDepthPlot.corner.y}, {x(farthest) - x(nearest), kDepthPlot.size.height}});
}

void series(Drawing& d, std::string_view style, const std::vector<Vec2d>& points) {
  Strokes strokes;
  for (const Vec2d& at : points) strokes.empty() ? strokes.from(at) : strokes.to(at);
  d.strokes("series " + std::string(style), strokes);
  for (const Vec2d& at : points) d.disc("point " + std::string(style), at, 3.5);
}

void key(Drawing& d) {
  const double y = kDepthPlot.corner.y - 14;
  const auto entry = [&d, y](double x, std::string_view style, std::string_view words) {
    d.line("series " + std::string(style), {x, y - 4.5}, {x + 22, y - 4.5});
    d.disc("point " + std::string(style), {x + 11, y - 4.5}, 3.5);
    d.text("tick begin", {x + 28, y}, words);
  };
  entry(206, "worst", "worst point");
  entry(344, "rms", "whole field");
}

}  // namespace

std::string depth_chart(const CalibrationReport& r) {
  const auto& depth = r.output.quality.uncertainty.depth;
  double most = 0;
  for (const DepthUncertainty& d : depth) most = std::max(most, d.worst_sigma_mm);
  const double step = tick_step(most, 5);
  double top = step;
  while (top < most) top += step;
  const Axis x{kFirstDepthMm, kFirstDepthMm + (kDepthSteps - 1) * kDepthStepMm, kDepthPlot.corner.x,
               kDepthPlot.right()};
  const Axis y{0, top, kDepthPlot.bottom(), kDepthPlot.corner.y};
  Drawing d(kDepthSize, "Chart: depth uncertainty over the distance from the left camera");
  held(d, x, r.output.quality);
  axes(d, x, y);
  d.line("marker", {x(kFaceMm), kDepthPlot.corner.y}, {x(kFaceMm), kDepthPlot.bottom()});
  d.text("note begin", {x(kFaceMm) + 5, kDepthPlot.corner.y + 13},
         "faces, " + figure(kFaceMm, 0) + " mm: " +
             figure(r.output.quality.face_depth_sigma_mm, decimals_of(r.output.quality.face_depth_sigma_mm)));
  std::vector<Vec2d> worst;
  std::vector<Vec2d> rms;
  for (const DepthUncertainty& one : depth) {
    worst.push_back({x(one.distance_mm), y(one.worst_sigma_mm)});
    rms.push_back({x(one.distance_mm), y(one.sigma_mm)});
  }
  series(d, "worst", worst);
  series(d, "rms", rms);
  key(d);
  return figure_of(
      d.svg(), "Depth uncertainty",
      "Over a field of 160 mm by 160 mm. 95 % of cases lie within 1.96 times the curve. Shaded: where "
      "boards were held.");
}

}  // namespace relievo::pipeline::report
