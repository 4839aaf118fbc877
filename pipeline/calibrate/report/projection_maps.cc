// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

constexpr double kLegend = 46;

// Light to dark at an even pace, so that it prints in grey as well.
std::string colour(double share) {
  constexpr std::array<std::array<double, 3>, 6> kStops = {
      {{245, 249, 240}, {190, 224, 214}, {108, 180, 194}, {48, 122, 170}, {34, 68, 128}, {20, 28, 70}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double rest = at - static_cast<double>(stop);
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string out = "#";
  for (std::size_t c = 0; c < 3; ++c) {
    const auto level =
        static_cast<unsigned>(std::lround(kStops[stop][c] + rest * (kStops[stop + 1][c] - kStops[stop][c])));
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

std::string projection_maps(const CalibrationReport& r) {
  const Scale scale = scale_of(r.output.quality.uncertainty);
  return "<section>\n<h2>Where the lenses are known</h2>\n<p class=\"lead\">How far a point’s picture may lie from where "
         "the calibration puts it, one sigma. Dark fields are those that no board came near.</p>\n" +
         side_by_side(map_figure(r, 0, scale), map_figure(r, 1, scale)) + "</section>\n";
}

}  // namespace relievo::pipeline::report
