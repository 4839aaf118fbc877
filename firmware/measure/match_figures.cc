// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/comparison.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "hal/base/statistics.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/image/plane_filters.h"
#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/model/vector3.h"

namespace relievo::firmware::compare {
namespace {

// Is it off by more than the limit? Nothing where no truth is known.
std::optional<bool> is_bad(const pipeline::Match& match, const std::optional<DisparityTruth>& truth,
                           double limit_px) {
  if (!truth) return std::nullopt;
  const int x = int(std::lround(match.left_px.x));
  const int y = int(std::lround(match.left_px.y));
  if (!truth->map.holds(x, y) || !truth->map.known(x, y)) return std::nullopt;
  const auto error = double(match.disparity_px - truth->map.at(x, y));
  return std::abs(error) > limit_px;
}

// Where on the right view each of the left's places should be found again.
std::vector<pipeline::Vec2d> expected_in_right(const pipeline::Keypoints& left,
                                               const pipeline::MatchSet& matches,
                                               const std::optional<DisparityTruth>& truth) {
  std::vector<pipeline::Vec2d> expected;
  if (!truth) {
    for (const pipeline::Match& match : matches.matches)
      if (match.rejected_by == 0)
        expected.push_back({double(match.left_px.x - match.disparity_px), double(match.left_px.y)});
    return expected;
  }
  for (const pipeline::Keypoint& place : left.points) {
    const int x = int(std::lround(place.at_px.x));
    const int y = int(std::lround(place.at_px.y));
    if (!truth->map.holds(x, y) || truth->seen[truth->map.index(x, y)] == 0) continue;
    expected.push_back({double(place.at_px.x - truth->map.at(x, y)), double(place.at_px.y)});
  }
  return expected;
}

// Does a place lie within kRepeatedPx?
bool repeated(const pipeline::Vec2d& expected, const std::vector<pipeline::Vec2d>& sorted_by_row) {
  const auto first = std::lower_bound(sorted_by_row.begin(), sorted_by_row.end(), expected.y - kRepeatedPx,
                                      [](const pipeline::Vec2d& p, double row) { return p.y < row; });
  for (auto it = first; it != sorted_by_row.end() && it->y <= expected.y + kRepeatedPx; ++it)
    if (std::hypot(it->x - expected.x, it->y - expected.y) <= kRepeatedPx) return true;
  return false;
}

double spread_of(const pipeline::RectifiedPair& pair, const pipeline::Keypoints& places) {
  constexpr int kCells = 16;
  std::vector<std::uint8_t> usable(kCells * kCells, 0);
  std::vector<std::uint8_t> held(kCells * kCells, 0);
  const auto cell = [&pair](int x, int y) {
    return std::size_t(y * kCells / pair.height_px * kCells + x * kCells / pair.width_px);
  };
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      const std::size_t k = std::size_t(y) * std::size_t(pair.width_px) + std::size_t(x);
      if (pair.left.valid[k] != 0 && (pair.region.empty() || pair.region[k] != 0)) usable[cell(x, y)] = 1;
    }
  for (const pipeline::Keypoint& place : places.points)
    held[cell(std::clamp(int(place.at_px.x), 0, pair.width_px - 1),
              std::clamp(int(place.at_px.y), 0, pair.height_px - 1))] = 1;
  int all = 0;
  int with = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    all += usable[i];
    with += usable[i] & held[i];
  }
  return all == 0 ? 0 : double(with) / all;
}

// Its region, where it has one, becomes that of the right view: where the map's disparities lead, and a pixel
// around.
void take_region(const DisparityMap& map, pipeline::RectifiedPair& right) {
  std::ranges::fill(right.region, std::uint8_t{0});
  for (int y = 0; y < map.height_px && !right.region.empty(); ++y)
    for (int x = 0; x < map.width_px; ++x) {
      if (!map.known(x, y)) continue;
      const int to = int(std::lround(float(x) - map.at(x, y)));
      for (int near = std::max(0, to - 1); near <= std::min(map.width_px - 1, to + 1); ++near)
        right.region[map.index(near, y)] = 1;
    }
}

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
  mirror_rows(view.mirrored, width, 1);
}

// Planes whose sums over a window give the correlation.
enum Product : std::size_t { Count, Left, Right, LeftLeft, RightRight, LeftRight };
using Products = std::array<Plane<float>, LeftRight + 1>;

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
      const std::array<float, LeftRight + 1> of{1, l, r, l * l, r * r, l * r};
      for (std::size_t i = 0; i < of.size(); ++i) p[i].row(y)[x] = of[i];
    }
}

double correlation(const Products& p, std::size_t k) {
  const auto mean = [&](Product of) { return double(p[of].values[k]) / double(p[Count].values[k]); };
  const double l = mean(Left);
  const double r = mean(Right);
  const double ll = std::max(mean(LeftLeft) - l * l, 0.0);
  const double rr = std::max(mean(RightRight) - r * r, 0.0);
  return (mean(LeftRight) - l * r) / std::sqrt(ll * rr + 1e-9);
}

}  // namespace

MatchFigures figures_of(const NamedSet& set, const pipeline::Keypoints& keypoints,
                        const pipeline::MatchSet& matches, const std::optional<DisparityTruth>& truth,
                        double limit_px) {
  MatchFigures f;
  f.keypoints = keypoints.points.size();
  f.matches = matches.matches.size();
  for (const std::string& name : pipeline::split_names(set.set.get("constraints")))
    if (name != "none") f.rules.push_back({name});
  for (const pipeline::Match& match : matches.matches) {
    const std::optional<bool> is = is_bad(match, truth, limit_px);
    const std::size_t judged = is ? 1 : 0, bad = is.value_or(false) ? 1 : 0;
    f.judged += judged;
    f.bad += bad;
    if (match.rejected_by == 0) {
      ++f.accepted;
      f.accepted_judged += judged;
      f.accepted_bad += bad;
      continue;
    }
    const auto rule = std::size_t(std::countr_zero(match.rejected_by));
    if (rule >= f.rules.size()) continue;
    ++f.rules[rule].rejected;
    f.rules[rule].judged += judged;
    f.rules[rule].bad += bad;
  }
  return f;
}

std::vector<std::uint8_t> rejected_map(const pipeline::MatchSet& matches, int width_px, int height_px) {
  std::vector<std::uint8_t> map(std::size_t(width_px) * std::size_t(height_px), 0);
  constexpr int kScatteredPx = 9;
  const int cell = matches.lattice_step_px > 0 ? matches.lattice_step_px : kScatteredPx;
  const int before = matches.lattice_step_px > 0 ? 0 : kScatteredPx / 2;
  for (const pipeline::Match& match : matches.matches) {
    if (match.rejected_by == 0) continue;
    const auto rule = std::uint8_t(1 + std::countr_zero(match.rejected_by));
    const int left = int(std::lround(match.left_px.x)) - before;
    const int top = int(std::lround(match.left_px.y)) - before;
    for (int y = std::max(0, top); y < std::min(height_px, top + cell); ++y)
      for (int x = std::max(0, left); x < std::min(width_px, left + cell); ++x)
        map[std::size_t(y) * std::size_t(width_px) + std::size_t(x)] = rule;
  }
  return map;
}

Result<pipeline::Keypoints> select_in_right(const pipeline::KeypointSelector& selector,
                                            const pipeline::RectifiedPair& pair, const DisparityMap& map,
                                            pipeline::StageContext& context) {
  pipeline::RectifiedPair swapped = pair;
  std::swap(swapped.left, swapped.right);
  swapped.left_centre_px = pair.right_centre_px;
  swapped.right_centre_px = pair.left_centre_px;
  take_region(map, swapped);
  return selector(swapped, context);
}

SelectorFigures selector_figures(const pipeline::RectifiedPair& pair, const pipeline::Keypoints& left,
                                 const pipeline::Keypoints& right, const pipeline::MatchSet& matches,
                                 const std::optional<DisparityTruth>& truth) {
  SelectorFigures f;
  f.left = left.points.size();
  f.right = right.points.size();
  for (const pipeline::Keypoint& place : left.points) f.places_px.push_back(place.at_px);
  std::vector<pipeline::Vec2d> places;
  for (const pipeline::Keypoint& place : right.points)
    places.push_back({double(place.at_px.x), double(place.at_px.y)});
  std::ranges::sort(places, [](const pipeline::Vec2d& a, const pipeline::Vec2d& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  });
  const std::vector<pipeline::Vec2d> expected = expected_in_right(left, matches, truth);
  f.asked = expected.size();
  const auto again =
      std::ranges::count_if(expected, [&places](const pipeline::Vec2d& at) { return repeated(at, places); });
  if (f.asked > 0) f.repeatability = double(again) / double(f.asked);
  const auto accepted =
      std::ranges::count_if(matches.matches, [](const pipeline::Match& m) { return m.rejected_by == 0; });
  if (f.left > 0) f.match_rate = double(accepted) / double(f.left);
  f.spread = spread_of(pair, left);
  return f;
}

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
  RELIEVO_TRY_ASSIGN(const auto algorithms, pipeline::make_algorithms(set));
  RELIEVO_TRY_ASSIGN(const pipeline::Keypoints keypoints, algorithms.selector(other, context));
  RELIEVO_TRY_ASSIGN(const pipeline::MatchSet matches, algorithms.matcher(other, keypoints, context));
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
  const auto plane = [&] { return Plane<float>(&context.scratch, pair.width_px, pair.height_px); };
  Products p{plane(), plane(), plane(), plane(), plane(), plane()};
  take_products(pair, model, p);
  Plane<float> across = plane();
  for (Plane<float>& one : p) pipeline::box_sum(one, kPhotoWindowPx / 2, context.pool, across, one);
  std::vector<float> all;
  constexpr float kFull = kPhotoWindowPx * kPhotoWindowPx;
  for (std::size_t k = 0; k < p[Count].values.size(); ++k)
    if (p[Count].values[k] >= kFull - 0.5F) all.push_back(float(correlation(p, k)));
  PhotoFigures figures;
  figures.asked = all.size();
  if (all.empty()) return figures;
  figures.median = median(all);
  figures.p5 = percentile(all, 0.05);
  return figures;
}

}  // namespace relievo::firmware::compare
