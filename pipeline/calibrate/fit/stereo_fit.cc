// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/stereo_fit.h"

#include <algorithm>
#include <cmath>

#include "hal/base/assert.h"

namespace relievo::pipeline {
namespace {

constexpr int kCameraGlobals = 9;
constexpr int kFirstDistortion = 4;
constexpr int kFolds = 5;

void set_free(bundle::Problem& problem, int base, int distortion_terms) {
  for (int i = 0; i < kFirstDistortion + distortion_terms; ++i)
    problem.free[static_cast<std::size_t>(base + i)] = true;
}

std::size_t place(const CameraFit& fit, int view) {
  const auto found = std::lower_bound(fit.views.begin(), fit.views.end(), view);
  RELIEVO_ASSERT(found != fit.views.end() && *found == view);
  return static_cast<std::size_t>(found - fit.views.begin());
}

const BoardCorners& corners_of(const CalibratorInput& input, bool right, int view) {
  const BoardView& v = input.views[static_cast<std::size_t>(view)];
  return right ? v.right : v.left;
}

// Squared residuals of boards that had no part in the fit, one a view; empty if a fold fails.
std::vector<double> held_out(const CalibratorInput& input, bool right, std::span<const int> views,
                             int terms) {
  std::vector<double> errors(views.size(), 0);
  CameraFit all;
  if (!fit_camera(input, right, views, terms, all)) return {};
  for (int fold = 0; fold < kFolds; ++fold) {
    std::vector<int> learn;
    std::vector<std::size_t> test;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (static_cast<int>(i) % kFolds == fold) test.push_back(i);
      else learn.push_back(views[i]);
    }
    CameraFit fit;
    if (test.empty() || !fit_camera(input, right, learn, terms, fit)) return {};
    bundle::Problem judge = fit.problem;
    judge.views.clear();
    for (const std::size_t i : test) judge.views.push_back(all.problem.views[i]);
    if (!bundle::solve_poses(judge)) return {};
    for (std::size_t k = 0; k < test.size(); ++k) errors[test[k]] = judge.views[k].squared_px[0];
  }
  return errors;
}

// Is the gain in prediction larger than its own standard error?
bool pays(const std::vector<double>& fewer, const std::vector<double>& more) {
  const double n = static_cast<double>(fewer.size());
  double mean = 0;
  double square = 0;
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    mean += (fewer[i] - more[i]) / n;
    square += (fewer[i] - more[i]) * (fewer[i] - more[i]) / n;
  }
  return mean > std::sqrt(std::max(0.0, square - mean * mean) / (n - 1));
}

bundle::Pose left_from_right_board(const bundle::Pose& right_from_left,
                                   const bundle::Pose& right_from_board) {
  const Eigen::Matrix3d back = right_from_left.rotation.transpose();
  return {back * right_from_board.rotation,
          back * (right_from_board.translation_mm - right_from_left.translation_mm)};
}

}  // namespace

double CameraFit::rms_px() const {
  return std::sqrt(2 * problem.squared_px / std::max(problem.residuals, 1));
}
double CameraFit::squared_px(int view) const { return problem.views[place(*this, view)].squared_px[0]; }
int CameraFit::corners(int view) const { return problem.views[place(*this, view)].corners[0]; }
const bundle::Pose& CameraFit::pose(int view) const {
  return problem.views[place(*this, view)].left_from_board;
}

double StereoFit::rms_px() const { return std::sqrt(paired_squared_px / std::max(paired_corners, 1)); }

bool fit_camera(const CalibratorInput& input, bool right, std::span<const int> views, int distortion_terms,
                CameraFit& fit) {
  fit.views.assign(views.begin(), views.end());
  bundle::Problem& p = fit.problem;
  p = {};
  p.pattern = input.pattern;
  p.camera[0].width_px = input.width_px;
  p.camera[0].height_px = input.height_px;
  for (const int view : views) p.views.emplace_back(&corners_of(input, right, view), nullptr, bundle::Pose{});
  if (!bundle::first_guess(p)) return false;
  set_free(p, 0, 0);
  if (!bundle::solve(p)) return false;
  set_free(p, 0, distortion_terms);
  if (!bundle::solve(p)) return false;
  fit.camera = p.camera[0];
  const int free = p.residuals - kFirstDistortion - distortion_terms - 6 * static_cast<int>(views.size());
  if (free <= 0) return false;
  fit.variance_px2 = p.squared_px / free;
  return true;
}

int choose_distortion_terms(const CalibratorInput& input, std::span<const int> left,
                            std::span<const int> right) {
  const auto predicted = [&](int terms) {
    std::vector<double> errors = held_out(input, false, left, terms);
    const std::vector<double> more = held_out(input, true, right, terms);
    if (errors.empty() || more.empty()) return std::vector<double>{};
    errors.insert(errors.end(), more.begin(), more.end());
    return errors;
  };
  int chosen = 1;
  std::vector<double> best = predicted(chosen);
  if (best.empty()) return chosen;
  for (const int terms : {2, 4, 5}) {
    const std::vector<double> candidate = predicted(terms);
    if (candidate.empty() || !pays(best, candidate)) continue;
    chosen = terms;
    best = candidate;
  }
  return chosen;
}

bundle::Pose relation_of(const CameraFits& cameras, int view) {
  const bundle::Pose& left = cameras.left.pose(view);
  const bundle::Pose& right = cameras.right.pose(view);
  const Eigen::Matrix3d rotation = right.rotation * left.rotation.transpose();
  return {rotation, right.translation_mm - rotation * left.translation_mm};
}

bool fit_stereo(const CalibratorInput& input, const CameraFits& cameras, std::span<const int> paired,
                const bundle::Pose& start, bool refine_cameras, StereoFit& fit) {
  fit.paired.assign(paired.begin(), paired.end());
  bundle::Problem& p = fit.problem;
  p = {};
  p.pattern = input.pattern;
  p.camera = {cameras.left.camera, cameras.right.camera};
  p.right_from_left = start;
  const auto is_paired = [&](int view) {
    return std::find(paired.begin(), paired.end(), view) != paired.end();
  };
  for (const int view : paired)
    p.views.emplace_back(&corners_of(input, false, view), &corners_of(input, true, view),
                         cameras.left.pose(view));
  if (refine_cameras) {
    for (const int view : cameras.left.views)
      if (!is_paired(view))
        p.views.emplace_back(&corners_of(input, false, view), nullptr, cameras.left.pose(view));
    for (const int view : cameras.right.views)
      if (!is_paired(view))
        p.views.emplace_back(nullptr, &corners_of(input, true, view),
                             left_from_right_board(start, cameras.right.pose(view)));
    set_free(p, 0, cameras.distortion_terms);
    set_free(p, kCameraGlobals, cameras.distortion_terms);
  }
  for (std::size_t i = 2 * kCameraGlobals; i < p.free.size(); ++i) p.free[i] = true;
  if (!bundle::solve(p)) return false;
  fit.paired_squared_px = 0;
  fit.paired_corners = 0;
  for (std::size_t k = 0; k < paired.size(); ++k) {
    fit.paired_squared_px += p.views[k].squared_px[0] + p.views[k].squared_px[1];
    fit.paired_corners += p.views[k].corners[0] + p.views[k].corners[1];
  }
  return true;
}

std::vector<double> judge_pairs(const CalibratorInput& input, const CameraFits& cameras, const StereoFit& fit,
                                std::span<const int> views, std::vector<bundle::View>* judged) {
  bundle::Problem p;
  p.pattern = input.pattern;
  p.camera = fit.problem.camera;
  p.right_from_left = fit.problem.right_from_left;
  std::vector<double> squared;
  // One at a time: a view far off must not hold up the damping of the others.
  for (const int view : views) {
    p.views = {{&corners_of(input, false, view), &corners_of(input, true, view), cameras.left.pose(view)}};
    const bool solved = bundle::solve_poses(p);
    squared.push_back(solved ? p.views[0].squared_px[0] + p.views[0].squared_px[1] : 1e12);
    if (judged != nullptr) judged->push_back(p.views[0]);
  }
  return squared;
}

}  // namespace relievo::pipeline
