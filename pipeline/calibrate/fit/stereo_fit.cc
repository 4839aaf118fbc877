// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/stereo_fit.h"

#include <algorithm>

#include "hal/base/assert.h"

namespace relievo::pipeline {
namespace {

using bundle::kCameraGlobals;
constexpr int kFirstDistortion = 4;

constexpr double kCentreSigma = 0.04;  // of the longer side
constexpr double kRadialSigma = 0.5;
constexpr double kTangentialSigma = 0.005;
constexpr double kAspectSigma = 0.02;

void set_free(bundle::Problem& problem, int eye, int count) {
  for (int i = 0; i < count; ++i) problem.free[std::size_t(eye * kCameraGlobals + i)] = true;
}

const BoardCorners& corners_of(const CalibratorInput& input, bool right, int view) {
  const BoardView& v = input.views[std::size_t(view)];
  return right ? v.right : v.left;
}

bundle::Pose left_from_right_board(const bundle::Pose& right_from_left,
                                   const bundle::Pose& right_from_board) {
  const Eigen::Matrix3d back = right_from_left.rotation.transpose();
  return {back * right_from_board.rotation,
          back * (right_from_board.translation_mm - right_from_left.translation_mm)};
}

bundle::CameraBelief belief_of(const CameraFit& alone, double slip) {
  return {bundle::parameters_of(alone.camera()),
          (slip - 1) * alone.problem.information.topLeftCorner<kCameraGlobals, kCameraGlobals>()};
}

void begin_at(const StereoFit& start, StereoFit& fit) {
  fit.problem.camera = start.problem.camera;
  fit.problem.right_from_left = start.problem.right_from_left;
  for (std::size_t k = 0; k < fit.views.size(); ++k) {
    const auto at = std::ranges::find(start.views, fit.views[k]);
    if (at == start.views.end()) continue;
    // A board seen by the right camera alone stands where that camera is: it moves with the relation.
    fit.problem.views[k].left_from_board =
        start.problem.views[std::size_t(at - start.views.begin())].left_from_board;
  }
}

}  // namespace

double CameraFit::rms_px() const {
  return std::sqrt(2 * problem.squared_px / std::max(problem.residuals, 1));
}
const bundle::View& CameraFit::view(int of) const {
  const auto found = std::lower_bound(views.begin(), views.end(), of);
  RELIEVO_ASSERT(found != views.end() && *found == of);
  return problem.views[std::size_t(found - views.begin())];
}

double CameraFits::noise_px2() const {
  return std::max(1e-6, 0.5 * (left.variance_px2 + right.variance_px2));
}

double StereoFit::rms_px() const { return std::sqrt(paired_squared_px / std::max(paired_corners, 1)); }

void set_priors(bundle::Problem& p, int eye) {
  const CameraIntrinsics& c = p.camera[std::size_t(eye)];
  const double side = std::max(c.width_px, c.height_px);
  const auto prior = [&](int i, double mean, double sigma) {
    p.prior[std::size_t(eye * kCameraGlobals + i)] = {mean, 1 / (sigma * sigma)};
  };
  prior(2, 0.5 * (c.width_px - 1), kCentreSigma * side);
  prior(3, 0.5 * (c.height_px - 1), kCentreSigma * side);
  for (const int radial : {4, 5, 8}) prior(radial, 0, kRadialSigma);
  for (const int tangential : {6, 7}) prior(tangential, 0, kTangentialSigma);
  p.aspect_weight[std::size_t(eye)] = 1 / (kAspectSigma * kAspectSigma);
}

bool fit_camera(const CalibratorInput& input, bool right, std::span<const int> views, CameraFit& fit) {
  fit.views.assign(views.begin(), views.end());
  bundle::Problem& p = fit.problem;
  p = {};
  p.pattern = input.pattern;
  p.camera[0].width_px = input.width_px;
  p.camera[0].height_px = input.height_px;
  for (const int view : views) p.views.emplace_back(&corners_of(input, right, view), nullptr, bundle::Pose{});
  bundle::first_guess(p);
  set_priors(p, 0);
  p.noise_px2 = 1;
  set_free(p, 0, kFirstDistortion);
  if (!bundle::solve(p)) return false;
  set_free(p, 0, kCameraGlobals);
  for (int round = 0; round < 2; ++round) {  // the noise weighs the priors, and comes out of the fit
    if (!bundle::solve(p)) return false;
    const int free = p.residuals - kCameraGlobals - 6 * int(views.size());
    if (free <= 0) return false;
    fit.variance_px2 = p.squared_px / free;
    p.noise_px2 = std::max(1e-6, fit.variance_px2);
  }
  return true;
}

bundle::Pose relation_of(const CameraFits& cameras, int view) {
  const bundle::Pose& left = cameras.left.pose(view);
  const bundle::Pose& right = cameras.right.pose(view);
  const Eigen::Matrix3d rotation = right.rotation * left.rotation.transpose();
  return {rotation, right.translation_mm - rotation * left.translation_mm};
}

bool fit_stereo(const CameraFits& cameras, std::span<const int> paired, const bundle::Pose& relation,
                double slip, const StereoFit* start, StereoFit& fit) {
  StereoFit made;
  made.paired.assign(paired.begin(), paired.end());
  bundle::Problem& p = made.problem;
  p.pattern = cameras.input.pattern;
  p.camera = {cameras.left.camera(), cameras.right.camera()};
  p.right_from_left = relation;
  const auto add = [&](int view, bool left, bool right) {
    made.views.push_back(view);
    p.views.emplace_back(
        left ? &corners_of(cameras.input, false, view) : nullptr,
        right ? &corners_of(cameras.input, true, view) : nullptr,
        left ? cameras.left.pose(view) : left_from_right_board(relation, cameras.right.pose(view)));
  };
  const auto is_paired = [&](int view) { return std::ranges::find(paired, view) != paired.end(); };
  for (const int view : paired) add(view, true, true);
  for (const int view : cameras.left.views)
    if (!is_paired(view)) add(view, true, false);
  for (const int view : cameras.right.views)
    if (!is_paired(view)) add(view, false, true);
  if (start != nullptr) begin_at(*start, made);
  for (const int eye : {0, 1}) {
    set_free(p, eye, kCameraGlobals);
    set_priors(p, eye);
  }
  for (std::size_t i = 2 * kCameraGlobals; i < p.free.size(); ++i) p.free[i] = true;
  p.noise_px2 = slip * cameras.noise_px2();
  p.belief = {belief_of(cameras.left, slip), belief_of(cameras.right, slip)};
  if (!bundle::solve(p)) return false;
  for (std::size_t k = 0; k < paired.size(); ++k) {
    made.paired_squared_px += p.views[k].squared_px[0] + p.views[k].squared_px[1];
    made.paired_corners += p.views[k].corners[0] + p.views[k].corners[1];
  }
  fit = std::move(made);
  return true;
}

std::vector<double> judge_pairs(const CameraFits& cameras, const StereoFit& fit, std::span<const int> views,
                                std::vector<bundle::View>* judged) {
  bundle::Problem p;
  p.pattern = cameras.input.pattern;
  p.camera = fit.problem.camera;
  p.right_from_left = fit.problem.right_from_left;
  std::vector<double> excess;
  // One at a time: a view far off must not hold up the damping of the others.
  for (const int view : views) {
    p.views.assign(1, {&corners_of(cameras.input, false, view), &corners_of(cameras.input, true, view),
                       cameras.left.pose(view)});
    const bool solved = bundle::solve_poses(p);
    const double together = solved ? p.views[0].squared_px[0] + p.views[0].squared_px[1] : 1e12;
    excess.push_back(together - cameras.squared_px(view));
    if (judged != nullptr) judged->push_back(p.views[0]);
  }
  return excess;
}

}  // namespace relievo::pipeline
