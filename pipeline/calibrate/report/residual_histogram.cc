// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

constexpr Size kHistogramSize{480, 190};
constexpr Box kHistogramPlot{{4, 10}, {472, 136}};
constexpr int kBins = 41;
constexpr double kReach = 4;  // standard deviations

// Both coordinates of every corner of the pairs used.
std::vector<double> coordinates(const CalibrationReport& r, std::size_t eye) {
  std::vector<double> all;
  for (std::size_t v = 0; v < r.output.views.size(); ++v) {
    if (!r.output.quality.views[v].used) continue;
    for (const CornerResidual& corner : corners_of(r.output.views[v], eye))
      if (seen(corner.at)) all.insert(all.end(), {corner.off.x, corner.off.y});
  }
  return all;
}

double deviation(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / std::max<double>(1, static_cast<double>(values.size())));
}

void ticks(Drawing& d, const Axis& x) {
  d.line("axis", {kHistogramPlot.corner.x, kHistogramPlot.bottom()},
         {kHistogramPlot.right(), kHistogramPlot.bottom()});
  const double step = tick_step(x.high - x.low, 9);
  const int last = static_cast<int>(x.high / step);
  for (int i = -last; i <= last; ++i) {
    d.line("axis", {x(i * step), kHistogramPlot.bottom()}, {x(i * step), kHistogramPlot.bottom() + 5});
    d.text("tick middle", {x(i * step), kHistogramPlot.bottom() + 20}, figure(i * step, tick_decimals(step)));
  }
  d.text("label middle",
         {0.5 * (kHistogramPlot.corner.x + kHistogramPlot.right()), kHistogramSize.height - 6},
         "residual of one coordinate, px");
}

std::string camera_figure(const CalibrationReport& r, std::size_t eye, double reach) {
  const std::vector<double> values = coordinates(r, eye);
  const double sigma = std::max(deviation(values), 1e-12);
  std::array<int, kBins> bins{};
  int beyond = 0;
  for (const double value : values) {
    const double bin = std::floor((value / reach + 1) / 2 * kBins);
    if (bin < 0 || bin >= kBins) ++beyond;
    else ++bins[static_cast<std::size_t>(bin)];
  }
  // What a normal distribution of the same size would put into the bin around `value`.
  const double width = 2 * reach / kBins;
  const auto normal = [&](double value) {
    constexpr double kRoot = 2.5066282746310002;
    return static_cast<double>(values.size()) * width / (kRoot * sigma) *
           std::exp(-0.5 * value * value / (sigma * sigma));
  };
  const double top = std::max<double>(*std::max_element(bins.begin(), bins.end()), normal(0)) * 1.04;
  const Axis x{-reach, reach, kHistogramPlot.corner.x, kHistogramPlot.right()};
  const Axis y{0, std::max(top, 1.0), kHistogramPlot.bottom(), kHistogramPlot.corner.y};
  Drawing d(kHistogramSize,
            std::string(kCameraNames[eye]) + ": histogram of the residuals with a normal distribution");
  const std::string style(kCameraStyles[eye]);
  for (int i = 0; i < kBins; ++i) {
    const double left = x(-reach + i * width);
    const double count = bins[static_cast<std::size_t>(i)];
    if (count > 0)
      d.box("bar " + style,
            {{left + 0.5, y(count)}, {x(-reach + (i + 1) * width) - left - 1, y(0) - y(count)}});
  }
  Strokes curve;
  constexpr int kPoints = 120;
  for (int i = 0; i <= kPoints; ++i) {
    const double value = -reach + 2 * reach * i / kPoints;
    const Vec2d at{x(value), y(normal(value))};
    i == 0 ? curve.from(at) : curve.to(at);
  }
  d.strokes("curve", curve);
  ticks(d, x);
  std::string caption = "Standard deviation " + figure(sigma, 3) + " px a coordinate";
  if (beyond > 0) caption += "; " + counted(beyond, "lies", "lie") + " beyond the ends";
  return figure_of(d.svg(), "", caption + ".");
}

}  // namespace

std::string residual_histogram(const CalibrationReport& r) {
  const double reach = kReach * std::max({deviation(coordinates(r, 0)), deviation(coordinates(r, 1)), 1e-9});
  return side_by_side(camera_figure(r, 0, reach), camera_figure(r, 1, reach));
}

}  // namespace relievo::pipeline::report
