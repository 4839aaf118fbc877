// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"

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

constexpr int kGrid = 8;  // as CalibrationQuality.coverage_left counts

struct Layers {
  Strokes dots, outlines;              // of pairs used
  Strokes other_dots, other_outlines;  // of pairs left out, which still speak for this camera's lens
  std::array<bool, kGrid * kGrid> covered{};
};

Layers layers_of(const CalibrationReport& r, std::size_t eye, double scale) {
  Layers layers;
  const CameraIntrinsics& camera = camera_of(r, eye);
  const std::size_t stride = corner_stride(r);
  std::size_t count = 0;
  for (std::size_t v = 0; v < r.output.views.size(); ++v) {
    const bool used = r.output.quality.views[v].used;
    std::vector<Vec2d> corners;
    for (const CornerResidual& corner : r.output.views[v].corners(eye)) {
      if (!seen(corner.at)) continue;
      const Vec2d at{(corner.at.x + 0.5) * scale, (corner.at.y + 0.5) * scale};
      corners.push_back(at);
      if (count++ % stride == 0) (used ? layers.dots : layers.other_dots).dot(at);
      const int x = std::clamp(int(corner.at.x / camera.width_px * kGrid), 0, kGrid - 1);
      const int y = std::clamp(int(corner.at.y / camera.height_px * kGrid), 0, kGrid - 1);
      layers.covered[std::size_t(y * kGrid + x)] = true;
    }
    (used ? layers.outlines : layers.other_outlines).outline(hull(std::move(corners)));
  }
  return layers;
}

void grid(Drawing& d, const Layers& layers, double height) {
  Strokes gaps;
  const Size cell{kFigureWidth / kGrid, height / kGrid};
  for (int y = 0; y < kGrid; ++y)
    for (int x = 0; x < kGrid; ++x) {
      const Vec2d corner{x * cell.width, y * cell.height};
      if (layers.covered[std::size_t(y * kGrid + x)]) continue;
      d.box("gap", {corner, cell});
      gaps.from({corner.x, corner.y + cell.height}).to({corner.x + cell.width, corner.y});
    }
  d.strokes("gapline", gaps);
  Strokes lines;
  for (int i = 1; i < kGrid; ++i) {
    lines.from({i * cell.width, 0}).to({i * cell.width, height});
    lines.from({0, i * cell.height}).to({kFigureWidth, i * cell.height});
  }
  d.strokes("grid", lines);
}

std::string camera_figure(const CalibrationReport& r, std::size_t eye) {
  const CameraIntrinsics& camera = camera_of(r, eye);
  const double scale = kFigureWidth / camera.width_px;
  const double height = scale * camera.height_px;
  const Layers layers = layers_of(r, eye, scale);
  Drawing d({kFigureWidth, height}, "Corners seen, in the frame of the picture");
  grid(d, layers, height);
  const std::string style(kCameraStyles[eye]);
  d.strokes("outline other", layers.other_outlines);
  d.strokes("outline " + style, layers.outlines);
  d.strokes("dots other", layers.other_dots);
  d.strokes("dots " + style, layers.dots);
  d.box("frame", {{0.5, 0.5}, {kFigureWidth - 1, height - 1}});
  const auto cells = std::ranges::count(layers.covered, true);
  return figure_of(
      d.svg(), kCameraNames[eye],
      "Corners in " + std::to_string(cells) + " of " + std::to_string(kGrid * kGrid) + " fields.");
}

constexpr double kLegend = 46;

// Light to dark at an even pace, so that it prints in grey as well.
std::string colour(double share) {
  constexpr std::array<std::array<double, 3>, 6> kStops = {
      {{245, 249, 240}, {190, 224, 214}, {108, 180, 194}, {48, 122, 170}, {34, 68, 128}, {20, 28, 70}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t stop = std::min(std::size_t(at), kStops.size() - 2);
  const double rest = at - double(stop);
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string out = "#";
  for (std::size_t c = 0; c < 3; ++c) {
    const auto level =
        unsigned(std::lround(kStops[stop][c] + rest * (kStops[stop + 1][c] - kStops[stop][c])));
    (out += kHex[level >> 4U]) += kHex[level & 15U];
  }
  return out;
}

// Logarithmic: the rim may be a hundred times less certain than the middle. One for both cameras.
struct Scale {
  double low, high;
  double share(double px) const { return std::log(std::max(px, low) / low) / std::log(high / low); }
};

Scale scale_of(const CalibrationUncertainty& u) {
  double least = 1e9;
  double most = 0;
  for (const ProjectionMap& map : u.projection)
    for (const double px : map.sigma_px) {
      least = std::min(least, px);
      most = std::max(most, px);
    }
  most = rounded_up(std::max(most, 1e-5));
  return {std::min(rounded_down(std::max(least, 1e-5)), 0.5 * most), most};
}

void legend(Drawing& d, const Scale& scale, double top) {
  constexpr int kSlices = 96;
  constexpr Box kBar{{0, 0}, {kFigureWidth - 40, 12}};
  for (int i = 0; i < kSlices; ++i)
    d.filled({{i * kBar.size.width / kSlices, top}, {kBar.size.width / kSlices + 0.5, kBar.size.height}},
             colour((i + 0.5) / kSlices));
  std::vector<double> ticks;
  double px = scale.low;
  while (px < scale.high * 1.01) {
    ticks.push_back(px);
    px = rounded_up(px * 1.5);
  }
  // Where 1, 2, 5 would crowd, the powers of ten and the ends are enough.
  const bool all = ticks.size() <= 8;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double power = std::log10(ticks[i]);
    if (!all && i != 0 && i + 1 != ticks.size() && std::abs(power - std::round(power)) > 1e-6) continue;
    const double x = scale.share(ticks[i]) * kBar.size.width;
    d.line("axis", {x, top + 12}, {x, top + 17});
    d.text(i == 0 ? "tick begin" : "tick middle", {x, top + 32}, figure(ticks[i], tick_decimals(ticks[i])));
  }
  d.text("tick end", {kFigureWidth, top + 11}, "px");
}

std::string map_figure(const CalibrationReport& r, std::size_t eye, const Scale& scale) {
  const ProjectionMap& map = r.output.quality.uncertainty.projection[eye];
  const CameraIntrinsics& camera = camera_of(r, eye);
  const double height = kFigureWidth * camera.height_px / camera.width_px;
  Drawing d({kFigureWidth, height + 14 + kLegend}, "Heat map: projection uncertainty over the picture");
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      d.filled({{column * kFigureWidth / map.columns, row * height / map.rows},
                {kFigureWidth / map.columns, height / map.rows}},
               colour(scale.share(map.at(column, row))));
  d.box("frame", {{0.5, 0.5}, {kFigureWidth - 1, height - 1}});
  legend(d, scale, height + 14);
  std::vector<double> sigmas = map.sigma_px;
  const double middle = sigmas.empty() ? 0 : median(sigmas);
  const double worst = sigmas.empty() ? 0 : percentile(sigmas, 1);
  return figure_of(d.svg(), kCameraNames[eye],
                   "Median " + figure(middle, decimals_for(middle)) + " px, worst " +
                       figure(worst, decimals_for(worst)) + " px.");
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

std::string coverage_figure(const CalibrationReport& r) {
  const std::size_t stride = corner_stride(r);
  std::string lead =
      "Every corner that took part, with the outline of its board. Hatched fields hold none: bring the board there. "
      "Grey: pairs left out; they still speak for this camera’s lens.";
  if (stride > 1) lead += " One corner in " + std::to_string(stride) + " is drawn.";
  return "<section>\n<h2>Where the board was seen</h2>\n<p class=\"lead\">" + lead + "</p>\n" +
         side_by_side(camera_figure(r, 0), camera_figure(r, 1)) + "</section>\n";
}

std::string projection_maps(const CalibrationReport& r) {
  const Scale scale = scale_of(r.output.quality.uncertainty);
  return "<section>\n<h2>Where the lenses are known</h2>\n<p class=\"lead\">How far a point’s picture may lie from where "
         "the calibration puts it, one sigma. Dark fields are those that no board came near.</p>\n" +
         side_by_side(map_figure(r, 0, scale), map_figure(r, 1, scale)) + "</section>\n";
}

}  // namespace relievo::pipeline::report
