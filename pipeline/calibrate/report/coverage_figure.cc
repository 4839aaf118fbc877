// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

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
    for (const CornerResidual& corner : corners_of(r.output.views[v], eye)) {
      if (!seen(corner.at)) continue;
      const Vec2d at{(corner.at.x + 0.5) * scale, (corner.at.y + 0.5) * scale};
      corners.push_back(at);
      if (count++ % stride == 0) (used ? layers.dots : layers.other_dots).dot(at);
      const int x = std::clamp(static_cast<int>(corner.at.x / camera.width_px * kGrid), 0, kGrid - 1);
      const int y = std::clamp(static_cast<int>(corner.at.y / camera.height_px * kGrid), 0, kGrid - 1);
      layers.covered[static_cast<std::size_t>(y * kGrid + x)] = true;
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
      if (layers.covered[static_cast<std::size_t>(y * kGrid + x)]) continue;
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
  const auto cells = std::count(layers.covered.begin(), layers.covered.end(), true);
  return figure_of(
      d.svg(), kCameraNames[eye],
      "Corners in " + std::to_string(cells) + " of " + std::to_string(kGrid * kGrid) + " fields.");
}

}  // namespace

std::string coverage_figure(const CalibrationReport& r) {
  const std::size_t stride = corner_stride(r);
  std::string lead =
      "Every corner that took part, with the outline of its board. Hatched fields hold none: bring the board there. "
      "Grey: pairs left out; they still speak for this camera’s lens.";
  if (stride > 1) lead += " One corner in " + std::to_string(stride) + " is drawn.";
  return "<section>\n<h2>Where the board was seen</h2>\n<p class=\"lead\">" + lead + "</p>\n" +
         side_by_side(camera_figure(r, 0), camera_figure(r, 1)) + "</section>\n";
}

}  // namespace relievo::pipeline::report
