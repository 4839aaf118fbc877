// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/chart/chart.h"

#include <algorithm>
#include <cmath>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

// Whether the chart must reach a vertex: measured, or completed and turned to the camera.
bool frames(const FaceMesh& mesh, std::size_t v) {
  constexpr float kLeastCosine = 0.2F;
  return mesh.measured.empty() || mesh.measured[v] != 0 ||
         -dot(mesh.normals[v], mesh.vertices_mm[v]) > kLeastCosine * length(mesh.vertices_mm[v]);
}

// Where every vertex falls, in pixels of the middle view; placed: inside both windows.
void project(const FaceMesh& mesh, const RectifiedPair& pair, Chart& chart) {
  constexpr double kNearestMm = 1;  // nothing is measured within a millimetre of the lens
  for (const Vec3f& v : mesh.vertices_mm) {
    const Vec3d p = apply(pair.rectified_from_left, Vec3d{double(v.x), double(v.y), double(v.z)});
    const double z = std::max(p.z, kNearestMm);
    const double left_x = pair.left_centre_px.x + pair.focal_px * p.x / z;
    const double y = pair.left_centre_px.y + pair.focal_px * p.y / z;
    const double disparity = pair.disparity_px(z);
    const double right_x = left_x - disparity;
    const bool inside = p.z > kNearestMm && std::min(left_x, right_x) >= 0 && y >= 0 &&
                        std::max(left_x, right_x) <= pair.width_px - 1 && y <= pair.height_px - 1;
    chart.texel.push_back({float(0.5 * (left_x + right_x)), float(y)});
    chart.disparity_px.push_back(float(disparity));
    chart.placed.push_back(inside ? 1 : 0);
  }
}

// How many pixels the better photograph has on what covers one pixel of the middle view, such that
// 95 % of the measured surface has no more. Areas of a triangle in the three views differ only by the
// disparities across it; the middle one is the mean of the outer two, so the answer is 1 to 2.
double pixels_a_pixel(const FaceMesh& mesh, const Chart& chart) {
  constexpr std::size_t kBins = 64;
  std::array<double, kBins> area{};
  double all = 0;
  for (const auto& t : mesh.triangles) {
    if (!all_three(chart.placed, t) || !(mesh.measured.empty() || all_three(mesh.measured, t))) continue;
    const double middle = double(-signed_area(chart, t));
    if (!(middle > 1e-6)) continue;
    const Vec2f& a = chart.texel[t[0]];
    const double db = double(chart.disparity_px[t[1]] - chart.disparity_px[t[0]]);
    const double dc = double(chart.disparity_px[t[2]] - chart.disparity_px[t[0]]);
    const double lean =
        std::abs(0.5 * (db * double(chart.texel[t[2]].y - a.y) - dc * double(chart.texel[t[1]].y - a.y)));
    const double ratio = std::clamp(1 + lean / middle, 1.0, 2.0);
    area[std::min(kBins - 1, std::size_t((ratio - 1) * kBins))] += middle;
    all += middle;
  }
  double below = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    below += area[bin];
    if (below >= 0.95 * all) return 1 + double(bin + 1) / kBins;
  }
  return 1;
}

}  // namespace

Chart lay_out(const FaceMesh& mesh, const RectifiedPair& pair, const ChartOptions& options,
              std::pmr::memory_resource* memory) {
  const std::size_t n = mesh.vertices_mm.size();
  Chart chart(memory);
  chart.texel.reserve(n);
  chart.disparity_px.reserve(n);
  chart.placed.reserve(n);
  project(mesh, pair, chart);
  Vec2d from{1e9, 1e9};
  Vec2d to{-1e9, -1e9};
  for (std::size_t v = 0; v < n; ++v) {
    if (chart.placed[v] == 0 || !frames(mesh, v)) continue;
    const Vec2d at{double(chart.texel[v].x), double(chart.texel[v].y)};
    from = {std::min(from.x, at.x), std::min(from.y, at.y)};
    to = {std::max(to.x, at.x), std::max(to.y, at.y)};
  }
  if (to.x < from.x) from = to = {0, 0};  // nothing was measured: everything goes to the side
  // An eighth of the width is kept for what does not fit into this chart.
  const double high = options.max_px - 2 * options.margin_px - 2;
  const double wide = options.max_px - options.max_px / 8 - 2 * options.margin_px - 2;
  chart.texels_per_px = std::min({options.finer * std::sqrt(pixels_a_pixel(mesh, chart)),
                                  wide / std::max(to.x - from.x, 1.0), high / std::max(to.y - from.y, 1.0)});
  const double scale = chart.texels_per_px;
  chart.origin_px = {from.x - options.margin_px / scale, from.y - options.margin_px / scale};
  chart.width_px = int(std::ceil((to.x - from.x) * scale)) + 2 * options.margin_px + 1;
  chart.height_px = int(std::ceil((to.y - from.y) * scale)) + 2 * options.margin_px + 1;
  for (std::size_t v = 0; v < n; ++v) {
    Vec2f& t = chart.texel[v];
    t = {float((double(t.x) - chart.origin_px.x) * scale), float((double(t.y) - chart.origin_px.y) * scale)};
    // Half a texel of the frame is left to the filter that reads the texture.
    if (!(t.x >= 0.5F && t.y >= 0.5F && t.x <= float(chart.width_px) - 1.5F &&
          t.y <= float(chart.height_px) - 1.5F))
      chart.placed[v] = 0;
  }
  return chart;
}

}  // namespace relievo::pipeline
