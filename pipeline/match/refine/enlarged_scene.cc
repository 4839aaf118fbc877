// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/enlarged_scene.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace relievo::pipeline {
namespace {

constexpr long kMostPixels =
    1'000'000;  // four times as many are matched in the memory there is for any picture
constexpr std::array<float, 4> kCubic{-0.0703125F, 0.8671875F, 0.2265625F,
                                      -0.0234375F};  // at a quarter of a pixel beyond the second

// Of what the fit to the enlarged pair holds for certain: half of it for the size, times root two because
// pixels that were put between others say nothing of their own (of four rendered heads, 0.66 to 0.71 and 0.93
// to 0.95 then lie within one and 1.96 sigma).
constexpr float kSigma = 0.70710678F;

// The old pixel `step` pixels (-1 .. 2, away from the nearest one) from new pixel `at`, at the border the
// last.
int tap(int at, int step, int size) {
  const int nearest = at / 2;
  return std::clamp((at & 1) != 0 ? nearest + step : nearest - step, 0, size - 1);
}

void enlarge_view(const RectifiedView& from, int width, int height, RectifiedView& to) {
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  to.grey.assign(4 * w * h, 0.0F);
  to.valid.assign(4 * w * h, 0);
  std::pmr::vector<float> row(w, to.grey.get_allocator());
  for (int y = 0; y < 2 * height; ++y) {
    std::fill(row.begin(), row.end(), 0.0F);
    for (std::size_t k = 0; k < kCubic.size(); ++k) {
      const float* old = &from.grey[static_cast<std::size_t>(tap(y, static_cast<int>(k) - 1, height)) * w];
      for (std::size_t x = 0; x < w; ++x) row[x] += kCubic[k] * old[x];
    }
    float* grey = &to.grey[static_cast<std::size_t>(y) * 2 * w];
    std::uint8_t* valid = &to.valid[static_cast<std::size_t>(y) * 2 * w];
    const std::uint8_t* was_valid = &from.valid[static_cast<std::size_t>(y / 2) * w];
    for (int x = 0; x < 2 * width; ++x) {
      float sum = 0;
      for (std::size_t k = 0; k < kCubic.size(); ++k)
        sum += kCubic[k] * row[static_cast<std::size_t>(tap(x, static_cast<int>(k) - 1, width))];
      grey[x] = std::clamp(sum, 0.0F, 255.0F);
      valid[x] = was_valid[x / 2];
    }
  }
}

// Old pixel centres in new pixels, and back.
double larger(double at) { return 2 * at + 0.5; }
double smaller(double at) { return (at - 0.5) / 2; }

}  // namespace

bool is_small_scene(const RectifiedPair& pair) {
  return pair.region.empty() && static_cast<long>(pair.width_px) * pair.height_px <= kMostPixels;
}

RectifiedPair enlarge(const RectifiedPair& pair, std::pmr::memory_resource* memory) {
  RectifiedPair made(memory);
  made.width_px = 2 * pair.width_px;
  made.height_px = 2 * pair.height_px;
  made.focal_px = 2 * pair.focal_px;
  made.baseline_mm = pair.baseline_mm;
  made.left_centre_px = {larger(pair.left_centre_px.x), larger(pair.left_centre_px.y)};
  made.right_centre_px = {larger(pair.right_centre_px.x), larger(pair.right_centre_px.y)};
  made.near_mm = pair.near_mm;
  made.far_mm = pair.far_mm;
  made.rectified_from_left = pair.rectified_from_left;
  made.rectified_from_right = pair.rectified_from_right;
  made.right_from_left = pair.right_from_left;
  enlarge_view(pair.left, pair.width_px, pair.height_px, made.left);
  enlarge_view(pair.right, pair.width_px, pair.height_px, made.right);
  return made;
}

Keypoints enlarge(const Keypoints& keypoints, std::pmr::memory_resource* memory) {
  Keypoints made(memory);
  made.lattice_step_px = 2 * keypoints.lattice_step_px;
  made.points.assign(keypoints.points.begin(), keypoints.points.end());
  for (Keypoint& point : made.points) point.at_px = {2 * point.at_px.x + 0.5F, 2 * point.at_px.y + 0.5F};
  return made;
}

void shrink(MatchSet& matches, int lattice_step_px) {
  for (Match& match : matches.matches) {
    match.left_px = {(match.left_px.x - 0.5F) / 2, (match.left_px.y - 0.5F) / 2};
    match.disparity_px /= 2;
    match.sigma_px *= kSigma;
  }
  EpipolarShift& shift = matches.epipolar_shift;
  shift.middle_x_px = smaller(shift.middle_x_px);
  shift.middle_y_px = smaller(shift.middle_y_px);
  for (double* length :
       {&shift.offset_px, &shift.spread_x_px, &shift.spread_y_px, &shift.residual_px, &shift.sigma_px})
    *length /= 2;
  for (double& v : shift.covariance_px2) v /= 4;
  matches.motion_px /= 2;
  matches.lattice_step_px = lattice_step_px;
}

}  // namespace relievo::pipeline
