// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/quality_measures.h"

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"
#include "pipeline/calibrate/fit/bundle.h"
#include "pipeline/calibrate/quality/rig_geometry.h"

namespace relievo::pipeline {
namespace {

// Is the board flat? The same bend in every view leaves the same pattern in the residuals of all of
// them, which no camera and no pose can: bending along, across and twisting are estimated by one
// Newton step from the fitted rig, everything else adapting.
struct BoardBend {
  double sag_mm = 0;      // greatest height above the board's mean plane, less the least
  double sigma_mm = 0;    // of the sag, one standard deviation
  double deviations = 0;  // how far from flat, in standard deviations (chi-square of 3, as a normal deviate)
};

using bundle::kGlobals;
constexpr int kShapes = 3;
using Shapes = Eigen::Matrix<double, kShapes, 1>;

// Height of a corner for one millimetre of each bend: along, across, twisted. Coordinates run from -1 to 1
// over the longer side.
Shapes shapes_at(const BoardPattern& pattern, int corner) {
  const double half = 0.5 * (std::max(pattern.columns, pattern.rows) - 1);
  const double u = (corner % pattern.columns - 0.5 * (pattern.columns - 1)) / half;
  const double v = (corner / pattern.columns - 0.5 * (pattern.rows - 1)) / half;
  return {u * u, v * v, u * v};
}

struct Sums {
  Eigen::Matrix<double, kShapes, kShapes> a = Eigen::Matrix<double, kShapes, kShapes>::Zero();
  Eigen::Matrix<double, kShapes, kGlobals> by_globals = Eigen::Matrix<double, kShapes, kGlobals>::Zero();
  Shapes g = Shapes::Zero();
};

struct ViewSums {
  bundle::Matrix6d c = bundle::Matrix6d::Zero();
  Eigen::Matrix<double, kShapes, 6> by_pose = Eigen::Matrix<double, kShapes, 6>::Zero();
  Eigen::Matrix<double, kGlobals, 6> globals_by_pose = Eigen::Matrix<double, kGlobals, 6>::Zero();
  bundle::Vector6d h = bundle::Vector6d::Zero();
};

template <int kEye>
void add(const bundle::Problem& p, const bundle::View& view, Sums& sums, ViewSums& of_view) {
  using Terms = bundle::CornerTerms<kEye>;
  if (view.seen[kEye] == nullptr) return;
  for (int i = 0; i < p.pattern.corners(); ++i) {
    if (!seen((*view.seen[kEye])[std::size_t(i)])) continue;
    const Terms t(p, view, i);
    const Eigen::Matrix<double, 2, kShapes> by_shape =
        t.by_left * view.left_from_board.rotation.col(2) * shapes_at(p.pattern, i).transpose();
    sums.a += by_shape.transpose() * by_shape;
    sums.g += by_shape.transpose() * t.residual;
    sums.by_globals.template middleCols<Terms::kOwn>(Terms::kBase) += by_shape.transpose() * t.by_own;
    of_view.by_pose += by_shape.transpose() * t.by_pose;
    of_view.globals_by_pose.template middleRows<Terms::kOwn>(Terms::kBase) +=
        t.by_own.transpose() * t.by_pose;
    of_view.c += t.by_pose.transpose() * t.by_pose;
    of_view.h += t.by_pose.transpose() * t.residual;
  }
}

// Peak to valley of a bend over the corners, once the plane that the poses take up is out.
double sag_of(const BoardPattern& pattern, const Shapes& bend) {
  Eigen::MatrixX3d plane(pattern.corners(), 3);
  Eigen::VectorXd height(pattern.corners());
  for (int i = 0; i < pattern.corners(); ++i) {
    plane.row(i) << 1, i % pattern.columns, i / pattern.columns;
    height[i] = shapes_at(pattern, i).dot(bend);
  }
  const Eigen::Matrix3d normal = plane.transpose() * plane;
  height -= plane * normal.ldlt().solve(plane.transpose() * height);
  return height.maxCoeff() - height.minCoeff();
}

// `solved`: a problem that solve() has just solved.
BoardBend measure_bend(const bundle::Problem& solved) {
  Sums sums;
  for (const bundle::View& view : solved.views) {
    ViewSums of_view;
    add<0>(solved, view, sums, of_view);
    add<1>(solved, view, sums, of_view);
    const auto pose = of_view.c.ldlt();
    sums.a -= of_view.by_pose * pose.solve(of_view.by_pose.transpose());
    sums.by_globals -= of_view.by_pose * pose.solve(of_view.globals_by_pose.transpose());
    sums.g -= of_view.by_pose * pose.solve(of_view.h);
  }
  for (int i = 0; i < kGlobals; ++i)
    if (!solved.free[std::size_t(i)]) sums.by_globals.col(i).setZero();
  const Eigen::Matrix3d information =
      sums.a - sums.by_globals * solved.covariance * sums.by_globals.transpose();
  const auto factor = information.ldlt();
  const Shapes bend = factor.solve(sums.g);
  const Eigen::Matrix3d covariance = solved.noise_px2 * factor.solve(Eigen::Matrix3d::Identity());
  BoardBend found;
  found.sag_mm = sag_of(solved.pattern, bend);
  for (int i = 0; i < kShapes; ++i)
    found.sigma_mm = std::max(
        found.sigma_mm, std::sqrt(std::max(0.0, covariance(i, i))) * sag_of(solved.pattern, Shapes::Unit(i)));
  // Wilson and Hilferty (1931).
  const double ratio = std::cbrt(std::max(0.0, bend.dot(information * bend)) / solved.noise_px2 / kShapes);
  const double spread = 2.0 / (9 * kShapes);
  found.deviations = (ratio - (1 - spread)) / std::sqrt(spread);
  return found;
}

struct Points {
  Cloud board;     // as the squares say
  Cloud expected;  // where the left camera sees them, by the size of the squares
  Cloud found;     // by both cameras
};

// Empty where the view cannot be placed.
Points points_of(const bundle::Problem& rig, const BoardView& view, const bundle::Pose& near) {
  bundle::Problem left;
  left.pattern = rig.pattern;
  left.camera = rig.camera;
  left.views.assign(1, {&view.left, nullptr, near});
  if (!bundle::solve_poses(left)) return {};
  const bundle::Pose& pose = left.views[0].left_from_board;
  const auto most = static_cast<Eigen::Index>(view.left.size());
  Points points{Cloud(3, most), Cloud(3, most), Cloud(3, most)};
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < view.left.size(); ++i) {
    if (!seen(view.left[i]) || !seen(view.right[i])) continue;
    const Eigen::Vector3d on_board = bundle::on_board(rig.pattern, int(i));
    points.board.col(count) = on_board;
    points.expected.col(count) = pose * on_board;
    points.found.col(count) = point_of(rig, view.left[i], view.right[i]);
    ++count;
  }
  for (Cloud* cloud : {&points.board, &points.expected, &points.found}) cloud->conservativeResize(3, count);
  return points;
}

double squared(double value) { return value * value; }

// Not-a-number of nothing: what was not measured is not perfect.
double rms(double squares, double count) { return std::sqrt(squares / count); }

// The calibration tried on boards whose size is known, each by the rig that is fitted without it. One camera
// and the known squares say how far away each corner is; both cameras together must find it there. That
// notices a camera that turned along the rows, which no epipolar line does, and needs no model of what goes
// wrong. Depth is brought to kFaceMm as a disparity's error grows, with the distance squared.
void measure_known_squares(const Fitted& f, const RigSpread& spread, CalibrationQuality& q) {
  double boards = 0;
  double corners = 0;
  double lengths = 0;
  double views = 0;
  double all = 0;
  for (std::size_t i = 0; i < f.selection.fit.paired.size(); ++i) {
    const Points p =
        points_of(spread.without()[i], f.cameras.input.views[std::size_t(f.selection.fit.paired[i])],
                  f.selection.fit.problem.views[i].left_from_board);
    if (p.found.cols() < 4) continue;
    const Eigen::ArrayXd off = (p.found.row(2) - p.expected.row(2)).transpose().array() *
                               (kFaceMm / p.expected.row(2).transpose().array()).square();
    boards += squared(off.mean());
    corners += off.square().sum();
    lengths += squared(scale_between(p.board, p.found) - 1);
    all += double(off.size());
    views += 1;
  }
  q.measured_depth_mm = rms(boards, views);
  q.measured_point_depth_mm = rms(corners, all);
  q.measured_length_percent = 100 * rms(lengths, views);
}

// What a calibration promises of the next picture: how far everything in it will lie off its epipolar
// lines together. Single corners miss their lines by their own noise, too, which says nothing about
// the rig; a linear field through a whole board's corners (offset, tilt across, tilt down) does, and it
// is what drift.h measures on a face.

struct Missed {
  Vec2d at;
  double distance_px = 0;  // signed, below the line
};

std::vector<Missed> missed_lines(const bundle::Problem& rig, const BoardView& view) {
  const double focal = 0.5 * (rig.camera[1].focal_px.x + rig.camera[1].focal_px.y);
  std::vector<Missed> all;
  for (std::size_t i = 0; i < view.left.size(); ++i) {
    if (!seen(view.left[i]) || !seen(view.right[i])) continue;
    const Eigen::Vector3d turned = rig.right_from_left.rotation * ray_of(rig.camera[0], view.left[i]);
    const Eigen::Vector3d line = rig.right_from_left.translation_mm.cross(turned);
    const double distance = focal * line.dot(ray_of(rig.camera[1], view.right[i])) / line.head<2>().norm();
    all.push_back({view.right[i], std::copysign(distance, line.y() * distance)});
  }
  return all;
}

// Sum over the corners of the squared linear field that fits their misses best.
double field_squared(const std::vector<Missed>& missed) {
  Vec2d middle;
  for (const Missed& m : missed) middle = {middle.x + m.at.x, middle.y + m.at.y};
  const auto count = double(missed.size());
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Missed& m : missed) {
    const Eigen::Vector3d basis(1, (m.at.x - middle.x / count) / 100, (m.at.y - middle.y / count) / 100);
    a += basis * basis.transpose();
    b += m.distance_px * basis;
  }
  return b.dot(solved<3>(a, b));
}

// Root mean square over the corners of all used views, each judged by the rig that is fitted without it.
double held_out_shift(const Fitted& f, const RigSpread& spread) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < f.selection.fit.paired.size(); ++i) {
    const auto missed =
        missed_lines(spread.without()[i], f.cameras.input.views[std::size_t(f.selection.fit.paired[i])]);
    if (missed.size() < 4) continue;
    sum += field_squared(missed);
    count += double(missed.size());
  }
  return rms(sum, count);
}

constexpr int kGrid = 8;
constexpr double kDegrees = 57.29577951308232;
// A spread of the pairs this many times the corners' noise is no accident of a firm rig.
constexpr double kSlipsVisibly = 1.3;

// What the views, the i-th by the rig rig_of(i), miss their epipolar lines by.
template <typename RigOf>
double epipolar_rms(const Fitted& f, std::span<const int> views, const RigOf& rig_of) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const BoardView& view = f.cameras.input.views[std::size_t(views[i])];
    sum += epipolar_squared(rig_of(i), view.left, view.right, count);
  }
  return rms(sum, count);
}

// By the boards of the fit: one that was left out tells nothing of the lens where it lay.
double coverage(const Fitted& f, bool right) {
  std::array<bool, kGrid * kGrid> covered{};
  for (const int of : (right ? f.cameras.right : f.cameras.left).views) {
    const BoardView& view = f.cameras.input.views[std::size_t(of)];
    for (const Vec2d& at : right ? view.right : view.left) {
      if (!seen(at)) continue;
      const int x = std::clamp(int(at.x / f.cameras.input.width_px * kGrid), 0, kGrid - 1);
      const int y = std::clamp(int(at.y / f.cameras.input.height_px * kGrid), 0, kGrid - 1);
      covered[std::size_t(y * kGrid + x)] = true;
    }
  }
  return double(std::ranges::count(covered, true)) / (kGrid * kGrid);
}

void measure_views(const Fitted& f, CalibrationQuality& q) {
  for (const int view : f.cameras.left.views)
    q.views[std::size_t(view)].left_rms_px = f.cameras.left.rms_px(view);
  for (const int view : f.cameras.right.views)
    q.views[std::size_t(view)].right_rms_px = f.cameras.right.rms_px(view);
  std::vector<bundle::View> judged;
  judge_pairs(f.cameras, f.selection.fit, f.pairs, &judged);
  std::vector<double> distances;
  std::vector<Eigen::Vector3d> normals;
  const auto fitted_rig = [&](std::size_t) -> const bundle::Problem& { return f.selection.fit.problem; };
  for (std::size_t i = 0; i < f.pairs.size(); ++i) {
    ViewQuality& view = q.views[std::size_t(f.pairs[i])];
    view.used = std::ranges::binary_search(f.selection.fit.paired, f.pairs[i]);
    view.left_rms_px = std::sqrt(judged[i].squared_px[0] / judged[i].corners[0]);
    view.right_rms_px = std::sqrt(judged[i].squared_px[1] / judged[i].corners[1]);
    view.epipolar_rms_px = epipolar_rms(f, f.pairs.subspan(i, 1), fitted_rig);
    view.excess_px =
        std::sqrt(f.selection.excess[i] / corners_seen(f.cameras.input.views[std::size_t(f.pairs[i])]));
    const bundle::Pose& pose = judged[i].left_from_board;
    view.distance_mm =
        (pose.rotation * bundle::middle_of(f.cameras.input.pattern) + pose.translation_mm).norm();
    view.tilt_deg = std::acos(std::clamp(std::abs(pose.rotation(2, 2)), 0.0, 1.0)) * kDegrees;
    if (!view.used) continue;
    distances.push_back(view.distance_mm);
    normals.emplace_back(pose.rotation.col(2));
  }
  q.working_distance_mm = median(distances);
  // Between two boards: boards held alike do not determine a focal length.
  std::vector<double> angles;
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i + 1; j < normals.size(); ++j)
      angles.push_back(std::acos(std::clamp(normals[i].dot(normals[j]), -1.0, 1.0)) * kDegrees);
  q.tilt_spread_deg = angles.empty() ? 0 : median(angles);
}

}  // namespace

int corners_seen(const BoardView& view) {
  return int(std::ranges::count_if(view.left, seen) + std::ranges::count_if(view.right, seen));
}

void measure_quality(const Fitted& f, CalibrationQuality& q) {
  measure_views(f, q);
  const StereoFit& fit = f.selection.fit;
  q.used = int(f.selection.fit.paired.size());
  q.left_rms_px = f.cameras.left.rms_px();
  q.right_rms_px = f.cameras.right.rms_px();
  q.pair_rms_px = fit.rms_px();
  const std::vector<int>& used = f.selection.fit.paired;
  const auto fitted_rig = [&](std::size_t) -> const bundle::Problem& { return fit.problem; };
  q.epipolar_rms_px = epipolar_rms(f, used, fitted_rig);
  q.coverage_left = coverage(f, false);
  q.coverage_right = coverage(f, true);
  const double noise = f.cameras.noise_px2();
  q.slip_ratio = std::sqrt(std::max(1.0, f.selection.spread_px2 / noise));
  // Twice the corner noise is beyond what a slightly bent board or a simple lens model explains.
  q.holds_still = q.slip_ratio < 2;
  const RigSpread spread(fit, q.slip_ratio > kSlipsVisibly);
  const auto rig_without = [&](std::size_t i) -> const bundle::Problem& { return spread.without()[i]; };
  q.held_out_epipolar_px = epipolar_rms(f, used, rig_without);
  q.held_out_shift_px = held_out_shift(f, spread);
  q.uncertainty = measure_uncertainty(spread, q.working_distance_mm);
  q.face_depth_sigma_mm = depth_uncertainty(spread, kFaceMm).sigma_mm;
  q.depth_sigma_mm = depth_uncertainty(spread, q.working_distance_mm).sigma_mm;
  q.shape_sigma_mm = q.uncertainty.shape_sigma_mm;
  measure_known_squares(f, spread, q);
  const ChangePoint& moved = f.selection.moved;
  const auto view_at = [&f](int pair) { return pair < 0 ? -1 : f.pairs[std::size_t(pair)]; };
  q.moved_after = view_at(moved.likeliest);
  q.moved_after_first = view_at(moved.first);
  q.moved_after_last = view_at(moved.last);
  q.baseline_mm = fit.problem.right_from_left.translation_mm.norm();
  if (!q.holds_still || q.used < int(f.pairs.size()))
    q.slip_cause = board_carried_on(f.cameras, f.pairs, fit.problem.right_from_left) ? SlipCause::BoardCarried
                                                                                     : SlipCause::CameraTurns;
  // Each camera's boards alone: there nothing that the two cameras do to each other can look like a bend.
  const BoardBend left = measure_bend(f.cameras.left.problem);
  const BoardBend right = measure_bend(f.cameras.right.problem);
  const BoardBend& surer = left.sigma_mm < right.sigma_mm ? left : right;
  const BoardPattern& pattern = f.cameras.input.pattern;
  const double size_mm = pattern.square_mm * (std::max(pattern.columns, pattern.rows) - 1);
  q.board_sag_mm = surer.sag_mm;
  q.board_sag_sigma_mm = surer.sigma_mm;
  constexpr double kCertain = 5;
  q.board_bent =
      left.deviations > kCertain && right.deviations > kCertain && surer.sag_mm > limits::kFlat * size_mm;
}

}  // namespace relievo::pipeline
