// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/board_bend.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "pipeline/calibrate/fit/corner_terms.h"

namespace relievo::pipeline {
namespace {

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
    if (!seen((*view.seen[kEye])[static_cast<std::size_t>(i)])) continue;
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

}  // namespace

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
    if (!solved.free[static_cast<std::size_t>(i)]) sums.by_globals.col(i).setZero();
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

}  // namespace relievo::pipeline
