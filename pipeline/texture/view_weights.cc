// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/view_weights.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

Vec3f right_camera_in_left(const RigidTransform& right_from_left) {
  const Vec3d c = inverse(right_from_left).translation_mm;
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
}

float cosine_towards(const Vec3f& camera, const Vec3f& at, const Vec3f& normal) {
  const Vec3f d{camera.x - at.x, camera.y - at.y, camera.z - at.z};
  const float length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  return length > 0 ? std::max(0.0F, (d.x * normal.x + d.y * normal.y + d.z * normal.z) / length) : 0;
}

// The right view's depth buffer, at the chart's scale. Rows of the chart are rows of both views, so
// it is filled by sliding every texel along its row by its disparity.
class RightView {
 public:
  RightView(const Chart& chart, std::span<const float> front, const RectifiedPair& pair, std::pmr::memory_resource* memory)
      : chart_(chart), pair_(pair), nearest_(memory) {
    float least = 1e30F;
    float most = kNoSurface;
    for (const float d : front) {
      if (d <= kNoSurface) continue;
      least = std::min(least, d);
      most = std::max(most, d);
    }
    const float scale = static_cast<float>(chart.texels_per_px);
    shift_ = std::floor(most * scale) + 1;
    // The range of disparities widens the row; a face's is below a few hundred pixels.
    width_ = chart.width_px + (most >= least ? static_cast<int>(std::min((most - least) * scale, 8192.0F)) + 3 : 0);
    nearest_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(chart.height_px), kNoSurface);
    for (int y = 0; y < chart.height_px; ++y) {
      const float* row = &front[static_cast<std::size_t>(y) * static_cast<std::size_t>(chart.width_px)];
      for (int x = 0; x < chart.width_px; ++x)
        if (row[x] > kNoSurface) splat(static_cast<float>(x) - row[x] * scale + shift_, y, row[x]);
    }
  }

  bool sees(const Vec2f& texel, float disparity_px, float tolerance_px) const {
    const float x = chart_.left_x(texel.x) - disparity_px;
    const float y = chart_.left_y(texel.y);
    if (x < 0 || y < 0 || x > static_cast<float>(pair_.width_px - 1) || y > static_cast<float>(pair_.height_px - 1)) return false;
    if (!pair_.right.valid.empty() &&
        pair_.right.valid[static_cast<std::size_t>(y) * static_cast<std::size_t>(pair_.width_px) + static_cast<std::size_t>(x)] == 0)
      return false;
    const int column = static_cast<int>(std::lround(texel.x - disparity_px * static_cast<float>(chart_.texels_per_px) + shift_));
    const int row = static_cast<int>(std::lround(texel.y));
    if (column < 0 || column >= width_ || row < 0 || row >= chart_.height_px) return true;
    return nearest_[index(column, row)] <= disparity_px + tolerance_px;
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
  }
  // Two columns: where the right view stretches the surface, one would leave gaps to look through.
  void splat(float x, int row, float disparity) {
    const int column = static_cast<int>(x);
    for (const int c : {column, column + 1}) {
      if (c < 0 || c >= width_) continue;
      float& nearest = nearest_[index(c, row)];
      nearest = std::max(nearest, disparity);
    }
  }

  const Chart& chart_;
  const RectifiedPair& pair_;
  float shift_ = 0;
  int width_ = 0;
  std::pmr::vector<float> nearest_;
};

bool front_in_left(const Chart& chart, std::span<const float> front, std::size_t v, float tolerance_px) {
  const int x = std::clamp(static_cast<int>(std::lround(chart.texel[v].x)), 0, chart.width_px - 1);
  const int y = std::clamp(static_cast<int>(std::lround(chart.texel[v].y)), 0, chart.height_px - 1);
  const std::size_t k = static_cast<std::size_t>(y) * static_cast<std::size_t>(chart.width_px) + static_cast<std::size_t>(x);
  return front[k] <= chart.disparity_px[v] + tolerance_px;
}

// Keeps away from occlusions by two edges, where the photograph already mixes front and back.
void shrink(const FaceMesh& mesh, std::span<float> weight, std::span<float> next) {
  for (int pass = 0; pass < 2; ++pass) {
    std::copy(weight.begin(), weight.end(), next.begin());
    for (const auto& t : mesh.triangles) {
      if (weight[t[0]] > 0 && weight[t[1]] > 0 && weight[t[2]] > 0) continue;
      for (const std::uint32_t v : t) next[v] = 0;
    }
    std::copy(next.begin(), next.end(), weight.begin());
  }
}

void feather(const FaceMesh& mesh, std::span<float> weight, std::span<float> sum, std::span<float> count, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    std::fill(sum.begin(), sum.end(), 0.0F);
    std::fill(count.begin(), count.end(), 0.0F);
    for (const auto& t : mesh.triangles) {
      const float all = weight[t[0]] + weight[t[1]] + weight[t[2]];
      for (const std::uint32_t v : t) {
        sum[v] += all;
        count[v] += 3;
      }
    }
    // A view that does not see a vertex gets no say in it, however smooth that would be.
    for (std::size_t v = 0; v < weight.size(); ++v)
      if (weight[v] > 0 && count[v] > 0) weight[v] = sum[v] / count[v];
  }
}

}  // namespace

std::pmr::vector<float> right_share(const FaceMesh& mesh, const RectifiedPair& pair, const Chart& chart,
                                    std::span<const float> front, const ViewWeightOptions& options,
                                    std::pmr::memory_resource* memory) {
  const std::size_t n = mesh.vertices_mm.size();
  const RightView right_view(chart, front, pair, memory);
  const Vec3f right_camera = right_camera_in_left(pair.right_from_left);
  std::pmr::vector<float> left(n, 0.0F, memory);
  std::pmr::vector<float> right(n, 0.0F, memory);
  std::pmr::vector<float> sum(n, 0.0F, memory);
  std::pmr::vector<float> count(n, 0.0F, memory);
  for (std::size_t v = 0; v < n; ++v) {
    left[v] = front_in_left(chart, front, v, options.occlusion_px) ? 1.0F : 0.0F;
    right[v] = right_view.sees(chart.texel[v], chart.disparity_px[v], options.occlusion_px) ? 1.0F : 0.0F;
  }
  for (const std::span<float> seen : {std::span<float>(left), std::span<float>(right)}) {
    shrink(mesh, seen, sum);
    feather(mesh, seen, sum, count, options.feather_passes);
  }
  std::pmr::vector<float> share(n, 0.0F, memory);
  for (std::size_t v = 0; v < n; ++v) {
    const float l = left[v] * std::pow(cosine_towards({}, mesh.vertices_mm[v], mesh.normals[v]), options.angle_power);
    const float r = right[v] * std::pow(cosine_towards(right_camera, mesh.vertices_mm[v], mesh.normals[v]), options.angle_power);
    share[v] = l + r > 1e-6F ? r / (l + r) : 0;
  }
  return share;
}

}  // namespace relievo::pipeline
