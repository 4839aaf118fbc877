// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/quality_measures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace relievo::pipeline {
namespace {

constexpr std::size_t kMaxGroups = 20;
constexpr int kGrid = 8;

// Of one camera's picture onto the plane z = 1, by Newton's fixed point.
Eigen::Vector3d ray_of(const CameraIntrinsics& c, const Vec2d& at) {
  const double u = (at.x - c.centre_px.x) / c.focal_px.x;
  const double v = (at.y - c.centre_px.y) / c.focal_px.y;
  const double* k = c.distortion;
  double x = u;
  double y = v;
  for (int i = 0; i < 50; ++i) {
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    x = (u - 2 * k[2] * x * y - k[3] * (r2 + 2 * x * x)) / radial;
    y = (v - k[2] * (r2 + 2 * y * y) - 2 * k[3] * x * y) / radial;
  }
  return {x, y, 1};
}

// Sum of squared distances (px of the right camera) of right corners from the epipolar planes.
double epipolar_squared(const bundle::Problem& p, const BoardView& view, int& count) {
  const bundle::Pose& relation = p.right_from_left;
  double sum = 0;
  for (std::size_t i = 0; i < view.left.size(); ++i) {
    if (!seen(view.left[i]) || !seen(view.right[i])) continue;
    ++count;
    const Eigen::Vector3d left = relation.rotation * ray_of(p.camera[0], view.left[i]);
    const Eigen::Vector3d right = ray_of(p.camera[1], view.right[i]);
    const Eigen::Vector3d line = relation.translation_mm.cross(left);
    const double distance = line.dot(right) / line.head<2>().norm();
    sum += distance * distance;
  }
  const double focal = 0.5 * (p.camera[1].focal_px.x + p.camera[1].focal_px.y);
  return sum * focal * focal;
}

double epipolar_rms(const Fitted& f, const StereoFit& fit, std::span<const int> views) {
  double sum = 0;
  int count = 0;
  for (const int view : views)
    sum += epipolar_squared(fit.problem, f.input.views[static_cast<std::size_t>(view)], count);
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

// The point nearest to both lines of sight, in the left camera's frame.
Eigen::Vector3d point_of(const bundle::Problem& p, const Vec2d& left, const Vec2d& right) {
  const Eigen::Matrix3d back = p.right_from_left.rotation.transpose();
  const Eigen::Vector3d a = ray_of(p.camera[0], left);
  const Eigen::Vector3d b = back * ray_of(p.camera[1], right);
  const Eigen::Vector3d c = -(back * p.right_from_left.translation_mm);
  const double den = a.dot(a) * b.dot(b) - a.dot(b) * a.dot(b);
  const double s = (c.dot(a) * b.dot(b) - c.dot(b) * a.dot(b)) / den;
  const double t = (c.dot(a) * a.dot(b) - c.dot(b) * a.dot(a)) / den;
  return 0.5 * (s * a + c + t * b);
}

constexpr int kProbes = 27;
using Cloud = Eigen::Matrix<double, 3, kProbes>;

// A box as large as a head around the middle of the field, as pixels of both pictures.
struct Probes {
  std::array<Vec2d, kProbes> left;
  std::array<Vec2d, kProbes> right;
};
Probes probes_at(const bundle::Problem& p, double distance) {
  constexpr double kStepMm = 75;
  Probes probes;
  for (int n = 0; n < kProbes; ++n) {
    bundle::Pose at;
    at.translation_mm = {(n % 3 - 1) * kStepMm, (n / 3 % 3 - 1) * kStepMm, distance + (n / 9 - 1) * kStepMm};
    probes.left[static_cast<std::size_t>(n)] = bundle::project(p.camera[0], at, 0, 0);
    at.translation_mm = p.right_from_left.rotation * at.translation_mm + p.right_from_left.translation_mm;
    probes.right[static_cast<std::size_t>(n)] = bundle::project(p.camera[1], at, 0, 0);
  }
  return probes;
}

Cloud cloud_of(const bundle::Problem& p, const Probes& probes) {
  Cloud cloud;
  for (int n = 0; n < kProbes; ++n)
    cloud.col(n) =
        point_of(p, probes.left[static_cast<std::size_t>(n)], probes.right[static_cast<std::size_t>(n)]);
  return cloud;
}

// What two clouds differ by when one is laid over the other (mean square, mm²): the error of shape.
double shape_difference(const Cloud& from, const Cloud& to) {
  const Eigen::Matrix4d lay = Eigen::umeyama(from, to, false);
  const Cloud laid =
      (lay.topLeftCorner<3, 3>() * from).colwise() + Eigen::Vector3d(lay.topRightCorner<3, 1>());
  return (laid - to).squaredNorm() / kProbes;
}

// Leaves out each group of used views in turn: what those views then miss their epipolar lines by,
// and by how much a head measured with it changes, where it stands and in shape. The spread is the
// jackknife's (Efron 1982), so it holds for a rig that slips, too, where the covariance of the fit would
// promise too much.
void leave_out(const Fitted& f, CalibrationQuality& q) {
  const std::vector<int>& used = f.selection.used;
  const bundle::Problem& whole = f.selection.fit.problem;
  const std::size_t groups = std::min<std::size_t>(used.size(), kMaxGroups);
  const Probes probes = probes_at(whole, q.working_distance_mm);
  const Cloud reference = cloud_of(whole, probes);
  double depth = 0;
  double shape = 0;
  double missed = 0;
  std::size_t tested = 0;
  double fits = 0;
  for (std::size_t group = 0; group < groups; ++group) {
    std::vector<int> learn;
    std::vector<int> test;
    for (std::size_t i = 0; i < used.size(); ++i) (i % groups == group ? test : learn).push_back(used[i]);
    StereoFit fit;
    if (learn.size() < 2 || !fit_stereo(f.input, f.cameras, learn, whole.right_from_left, true, fit))
      continue;
    const double rms = epipolar_rms(f, fit, test);
    missed += rms * rms * static_cast<double>(test.size());
    tested += test.size();
    fits += 1;
    const Cloud cloud = cloud_of(fit.problem, probes);
    depth += (cloud - reference).row(2).squaredNorm() / kProbes;
    shape += shape_difference(cloud, reference);
  }
  if (fits < 2) return;
  q.held_out_epipolar_px = std::sqrt(missed / static_cast<double>(tested));
  q.depth_sigma_mm = std::sqrt((fits - 1) / fits * depth);
  q.shape_sigma_mm = std::sqrt((fits - 1) / fits * shape);
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
    view.epipolar_rms_px = epipolar_rms(f, f.selection.fit, one);
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
  q.epipolar_rms_px = epipolar_rms(f, fit, f.selection.used);
  leave_out(f, q);
  q.coverage_left = coverage(f.input, false);
  q.coverage_right = coverage(f.input, true);
  const double noise = std::max(1e-6, 0.5 * (f.cameras.left.variance_px2 + f.cameras.right.variance_px2));
  q.slip_ratio = std::sqrt(std::max(1.0, f.selection.spread_px2 / noise));
  // Twice the corner noise is beyond what a slightly bent board or a simple lens model explains.
  q.holds_still = q.slip_ratio < 2;
  const ChangePoint moved = change_point(f.selection.excess, std::max(f.selection.spread_px2, noise));
  const auto view_at = [&f](int pair) { return pair < 0 ? -1 : f.pairs[static_cast<std::size_t>(pair)]; };
  q.moved_after = view_at(moved.likeliest);
  q.moved_after_first = view_at(moved.first);
  q.moved_after_last = view_at(moved.last);
  q.distortion_terms = f.cameras.distortion_terms;
  q.baseline_mm = fit.problem.right_from_left.translation_mm.norm();
}

}  // namespace relievo::pipeline
