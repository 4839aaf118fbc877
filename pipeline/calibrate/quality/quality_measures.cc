// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/quality_measures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/calibrate/quality/rig_geometry.h"
#include "pipeline/calibrate/quality/rig_spread.h"

namespace relievo::pipeline {
namespace {

constexpr int kGrid = 8;
// A spread of the pairs this many times the corners' noise is no accident of a firm rig.
constexpr double kSlipsVisibly = 1.3;

double epipolar_rms(const Fitted& f, const bundle::Problem& rig, std::span<const int> views) {
  double sum = 0;
  int count = 0;
  for (const int view : views)
    sum += epipolar_squared(rig, f.input.views[static_cast<std::size_t>(view)].left, f.input.views[static_cast<std::size_t>(view)].right, count);
  return std::sqrt(sum / std::max(count, 1));
}

double coverage(const CalibratorInput& input, bool right) {
  std::array<bool, kGrid * kGrid> covered{};
  for (const BoardView& view : input.views)
    for (const Vec2d& at : right ? view.right : view.left) {
      if (!seen(at)) continue;
      const int x = std::clamp(static_cast<int>(at.x / input.width_px * kGrid), 0, kGrid - 1);
      const int y = std::clamp(static_cast<int>(at.y / input.height_px * kGrid), 0, kGrid - 1);
      covered[static_cast<std::size_t>(y * kGrid + x)] = true;
    }
  return static_cast<double>(std::count(covered.begin(), covered.end(), true)) / (kGrid * kGrid);
}

// What a view misses its epipolar lines by when it had no part in the fit.
double held_out_epipolar(const Fitted& f, const RigSpread& spread) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < f.selection.used.size(); ++i) {
    const BoardView& view = f.input.views[static_cast<std::size_t>(f.selection.used[i])];
    sum += epipolar_squared(spread.without()[i], view.left, view.right, count);
  }
  return std::sqrt(sum / std::max(count, 1));
}

void measure_views(const Fitted& f, CalibrationQuality& q) {
  for (const int view : f.cameras.left.views)
    q.views[static_cast<std::size_t>(view)].left_rms_px =
        std::sqrt(f.cameras.left.squared_px(view) / f.cameras.left.corners(view));
  for (const int view : f.cameras.right.views)
    q.views[static_cast<std::size_t>(view)].right_rms_px =
        std::sqrt(f.cameras.right.squared_px(view) / f.cameras.right.corners(view));
  std::vector<bundle::View> judged;
  judge_pairs(f.input, f.cameras, f.selection.fit, f.pairs, &judged);
  std::vector<double> distances;
  const double middle[2] = {0.5 * (f.input.pattern.columns - 1) * f.input.pattern.square_mm,
                            0.5 * (f.input.pattern.rows - 1) * f.input.pattern.square_mm};
  for (std::size_t i = 0; i < f.pairs.size(); ++i) {
    ViewQuality& view = q.views[static_cast<std::size_t>(f.pairs[i])];
    view.used = std::binary_search(f.selection.used.begin(), f.selection.used.end(), f.pairs[i]);
    view.left_rms_px = std::sqrt(judged[i].squared_px[0] / judged[i].corners[0]);
    view.right_rms_px = std::sqrt(judged[i].squared_px[1] / judged[i].corners[1]);
    const int one[] = {f.pairs[i]};
    view.epipolar_rms_px = epipolar_rms(f, f.selection.fit.problem, one);
    view.excess_px = std::sqrt(f.selection.excess[i] / (2 * f.input.pattern.corners()));
    const bundle::Pose& pose = judged[i].left_from_board;
    view.distance_mm =
        (pose.rotation * Eigen::Vector3d(middle[0], middle[1], 0) + pose.translation_mm).norm();
    if (view.used) distances.push_back(view.distance_mm);
  }
  const auto half = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), half, distances.end());
  q.working_distance_mm = *half;
}

}  // namespace

void measure_quality(const Fitted& f, CalibrationQuality& q) {
  measure_views(f, q);
  const StereoFit& fit = f.selection.fit;
  q.used = static_cast<int>(f.selection.used.size());
  q.left_rms_px = f.cameras.left.rms_px();
  q.right_rms_px = f.cameras.right.rms_px();
  q.pair_rms_px = fit.rms_px();
  q.epipolar_rms_px = epipolar_rms(f, fit.problem, f.selection.used);
  q.coverage_left = coverage(f.input, false);
  q.coverage_right = coverage(f.input, true);
  const double noise = f.cameras.noise_px2();
  q.slip_ratio = std::sqrt(std::max(1.0, f.selection.spread_px2 / noise));
  // Twice the corner noise is beyond what a slightly bent board or a simple lens model explains.
  q.holds_still = q.slip_ratio < 2;
  const RigSpread spread(fit, noise, q.slip_ratio > kSlipsVisibly);
  q.held_out_epipolar_px = held_out_epipolar(f, spread);
  q.uncertainty = measure_uncertainty(spread, q.working_distance_mm);
  q.depth_sigma_mm = depth_uncertainty(spread, q.working_distance_mm).sigma_mm;
  q.shape_sigma_mm = q.uncertainty.shape_sigma_mm;
  const ChangePoint moved = change_point(f.selection.excess, std::max(f.selection.spread_px2, noise));
  const auto view_at = [&f](int pair) { return pair < 0 ? -1 : f.pairs[static_cast<std::size_t>(pair)]; };
  q.moved_after = view_at(moved.likeliest);
  q.moved_after_first = view_at(moved.first);
  q.moved_after_last = view_at(moved.last);
  q.baseline_mm = fit.problem.right_from_left.translation_mm.norm();
}

}  // namespace relievo::pipeline
