// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/self_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/match/image/box_filter.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/model/vector3.h"

namespace relievo::firmware::compare {
namespace {

using pipeline::Plane;

template <typename T>
void mirror_rows(std::pmr::vector<T>& values, int width, int channels) {
  const auto w = std::size_t(width);
  const auto n = std::size_t(channels);
  for (std::size_t row = 0; row + w * n <= values.size(); row += w * n)
    for (std::size_t x = 0; x < w / 2; ++x)
      for (std::size_t c = 0; c < n; ++c)
        std::swap(values[row + x * n + c], values[row + (w - 1 - x) * n + c]);
}

void mirror(pipeline::RectifiedView& view, int width) {
  mirror_rows(view.grey, width, 1);
  mirror_rows(view.rgb, width, 3);
  mirror_rows(view.valid, width, 1);
}

// Planes whose sums over a window give the correlation.
struct Products {
  Products(std::pmr::memory_resource* memory, int w, int h)
      : count(memory, w, h),
        left(memory, w, h),
        right(memory, w, h),
        left_left(memory, w, h),
        right_right(memory, w, h),
        left_right(memory, w, h) {}
  Plane<float> count, left, right, left_left, right_right, left_right;
};

void take_products(const pipeline::RectifiedPair& pair, const DisparityMap& map, Products& p) {
  const auto w = std::size_t(pair.width_px);
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      if (!map.known(x, y)) continue;
      const float at = float(x) - map.at(x, y);
      const int k = int(std::floor(at));
      if (k < 0 || k + 1 >= pair.width_px) continue;
      const std::size_t right = std::size_t(y) * w + std::size_t(k);
      if ((pair.right.valid[right] & pair.right.valid[right + 1] & pair.left.valid[map.index(x, y)]) == 0)
        continue;
      const float r =
          pair.right.grey[right] + (at - float(k)) * (pair.right.grey[right + 1] - pair.right.grey[right]);
      const float l = pair.left.grey[map.index(x, y)];
      p.count.row(y)[x] = 1;
      p.left.row(y)[x] = l;
      p.right.row(y)[x] = r;
      p.left_left.row(y)[x] = l * l;
      p.right_right.row(y)[x] = r * r;
      p.left_right.row(y)[x] = l * r;
    }
}

double correlation(const Products& p, std::size_t k) {
  const double n = double(p.count.values[k]);
  const auto mean = [&](const Plane<float>& plane) { return double(plane.values[k]) / n; };
  const double l = mean(p.left);
  const double r = mean(p.right);
  const double ll = std::max(mean(p.left_left) - l * l, 0.0);
  const double rr = std::max(mean(p.right_right) - r * r, 0.0);
  return (mean(p.left_right) - l * r) / std::sqrt(ll * rr + 1e-9);
}

}  // namespace

pipeline::RectifiedPair mirrored(const pipeline::RectifiedPair& pair, const DisparityMap& map) {
  pipeline::RectifiedPair other = pair;
  std::swap(other.left, other.right);
  mirror(other.left, pair.width_px);
  mirror(other.right, pair.width_px);
  const double last = pair.width_px - 1;
  other.left_centre_px = {last - pair.right_centre_px.x, pair.right_centre_px.y};
  other.right_centre_px = {last - pair.left_centre_px.x, pair.left_centre_px.y};
  const int face_x = std::clamp(int(pair.face_centre_px.x), 0, pair.width_px - 1);
  const int face_y = std::clamp(int(pair.face_centre_px.y), 0, pair.height_px - 1);
  const double between = map.known(face_x, face_y) ? double(map.at(face_x, face_y))
                                                   : pair.disparity_px(0.5 * (pair.near_mm + pair.far_mm));
  other.face_centre_px = {last - (pair.face_centre_px.x - between), pair.face_centre_px.y};
  take_region(map, other);
  mirror_rows(other.region, pair.width_px, 1);
  return other;
}

Result<LeftRightFigures> left_right_figures(const pipeline::RectifiedPair& pair,
                                            const pipeline::AlgorithmSet& set, const DisparityMap& map,
                                            const std::optional<DisparityMap>& model,
                                            pipeline::StageContext& context) {
  const pipeline::RectifiedPair other = mirrored(pair, map);
  RELIEVO_TRY_ASSIGN(const auto selector, pipeline::make_selector(set));
  RELIEVO_TRY_ASSIGN(const auto matcher, pipeline::make_matcher(set));
  RELIEVO_TRY_ASSIGN(const pipeline::Keypoints keypoints, selector(other, context));
  RELIEVO_TRY_ASSIGN(const pipeline::MatchSet matches, matcher(other, keypoints, context));
  const DisparityMap back = disparity_map(matches, pair.width_px, pair.height_px);
  LeftRightFigures figures;
  std::vector<float> apart;
  std::size_t close = 0;
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      if (!map.known(x, y) || (model && !model->known(x, y))) continue;
      ++figures.asked;
      const float at = float(pair.width_px - 1) - (float(x) - map.at(x, y));
      const int k = int(std::floor(at));
      if (!back.holds(k, y) || !back.holds(k + 1, y) || !back.known(k, y) || !back.known(k + 1, y)) continue;
      const float there = back.at(k, y) + (at - float(k)) * (back.at(k + 1, y) - back.at(k, y));
      apart.push_back(std::abs(there - map.at(x, y)));
      close += apart.back() <= 1 ? 1 : 0;
    }
  figures.answered = apart.size();
  if (apart.empty()) return figures;
  figures.median_px = median(apart);
  figures.p95_px = percentile(apart, 0.95);
  figures.within_1px = double(close) / double(apart.size());
  return figures;
}

DisparityMap model_view(const pipeline::RectifiedPair& pair, const pipeline::FaceMesh& mesh) {
  DisparityMap map(pair.width_px, pair.height_px);
  for (const auto& t : mesh.triangles) {
    std::array<pipeline::Vec2f, 3> px;
    std::array<float, 3> disparity{};
    bool front = true;
    for (std::size_t k = 0; k < 3 && front; ++k) {
      const pipeline::Vec3d p = apply(pair.rectified_from_left, wide(mesh.vertices_mm[t[k]]));
      front = p.z > 0;
      px[k] = {float(pair.left_centre_px.x + pair.focal_px * p.x / p.z),
               float(pair.left_centre_px.y + pair.focal_px * p.y / p.z)};
      disparity[k] = float(pair.disparity_px(p.z));
    }
    if (!front) continue;
    // A plane's disparity is linear over the picture, so that it may be interpolated there.
    pipeline::for_each_texel(px[0], px[1], px[2], pair.width_px, {0, pair.height_px},
                             [&](int x, int y, float a, float b, float c) {
                               const float d = a * disparity[0] + b * disparity[1] + c * disparity[2];
                               float& here = map.values[map.index(x, y)];
                               if (std::isnan(here) || d > here) here = d;  // the nearer one hides the other
                             });
  }
  return map;
}

PhotoFigures photo_figures(const pipeline::RectifiedPair& pair, const DisparityMap& model,
                           pipeline::StageContext& context) {
  Products p(&context.scratch, pair.width_px, pair.height_px);
  take_products(pair, model, p);
  Plane<float> across(&context.scratch, pair.width_px, pair.height_px);
  for (Plane<float>* plane : {&p.count, &p.left, &p.right, &p.left_left, &p.right_right, &p.left_right})
    pipeline::box_sum(*plane, kPhotoWindowPx / 2, context.pool, across, *plane);
  std::vector<float> all;
  constexpr float kFull = kPhotoWindowPx * kPhotoWindowPx;
  for (std::size_t k = 0; k < p.count.values.size(); ++k)
    if (p.count.values[k] >= kFull - 0.5F) all.push_back(float(correlation(p, k)));
  PhotoFigures figures;
  figures.asked = all.size();
  if (all.empty()) return figures;
  figures.median = median(all);
  figures.p5 = percentile(all, 0.05);
  return figures;
}

}  // namespace relievo::firmware::compare
