// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/rig_geometry.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pipeline/model/lens.h"

namespace relievo::pipeline {

Eigen::Vector3d ray_of(const CameraIntrinsics& camera, const Vec2d& at) {
  const Vec2d ray = ray_of_pixel(camera, at);
  return {ray.x, ray.y, 1};
}

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

double epipolar_squared(const bundle::Problem& p, const BoardCorners& left, const BoardCorners& right,
                        int& count) {
  const bundle::Pose& relation = p.right_from_left;
  double sum = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (!seen(left[i]) || !seen(right[i])) continue;
    ++count;
    const Eigen::Vector3d turned = relation.rotation * ray_of(p.camera[0], left[i]);
    const Eigen::Vector3d line = relation.translation_mm.cross(turned);
    const double distance = line.dot(ray_of(p.camera[1], right[i])) / line.head<2>().norm();
    sum += distance * distance;
  }
  const double focal = 0.5 * (p.camera[1].focal_px.x + p.camera[1].focal_px.y);
  return sum * focal * focal;
}

Probes probes_of(const bundle::Problem& p, const std::vector<Eigen::Vector3d>& points) {
  Probes probes;
  for (const Eigen::Vector3d& point : points) {
    bundle::Pose at;
    at.translation_mm = point;
    probes.left.push_back(bundle::project(p.camera[0], at, 0, 0));
    at.translation_mm = p.right_from_left.rotation * point + p.right_from_left.translation_mm;
    probes.right.push_back(bundle::project(p.camera[1], at, 0, 0));
  }
  return probes;
}

Cloud cloud_of(const bundle::Problem& p, const Probes& probes) {
  Cloud cloud(3, static_cast<Eigen::Index>(probes.left.size()));
  for (std::size_t n = 0; n < probes.left.size(); ++n)
    cloud.col(static_cast<Eigen::Index>(n)) = point_of(p, probes.left[n], probes.right[n]);
  return cloud;
}

Cloud shape_difference(const Cloud& from, const Cloud& to) {
  const Eigen::Matrix4d lay = Eigen::umeyama(from, to, false);
  return ((lay.topLeftCorner<3, 3>() * from).colwise() + Eigen::Vector3d(lay.topRightCorner<3, 1>())) - to;
}

double scale_between(const Cloud& from, const Cloud& to) {
  const Eigen::Matrix4d lay = Eigen::umeyama(from, to, true);
  return lay.topLeftCorner<3, 3>().col(0).norm();
}

RigSpread::RigSpread(const StereoFit& fit, bool slips) : likeliest_(fit.problem), slips_(slips) {
  std::vector<bundle::Problem> without = bundle::without_each_view(fit.problem);
  without.resize(fit.paired.size());
  without_ = std::move(without);
  likeliest_.views.clear();  // the globals are what is spread; poses would be copied for nothing
  for (bundle::Problem& one : without_) one.views.clear();
  // Parameters differ by orders of magnitude: equilibrate, or the small ones drown in rounding.
  const bundle::Globals& covariance = fit.problem.covariance;
  const bundle::GlobalVector unit = covariance.diagonal().cwiseMax(1e-30).cwiseSqrt();
  const bundle::Globals even =
      unit.cwiseInverse().asDiagonal() * covariance * unit.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<bundle::Globals> eigen(0.5 * (even + even.transpose()));
  for (int i = 0; i < bundle::kGlobals; ++i) {
    const double length = std::sqrt(std::max(0.0, eigen.eigenvalues()[i]) * fit.problem.noise_px2);
    const bundle::GlobalVector step = length * unit.cwiseProduct(eigen.eigenvectors().col(i));
    above_.push_back(likeliest_);
    bundle::step_globals(above_.back(), step);
    below_.push_back(likeliest_);
    bundle::step_globals(below_.back(), -step);
  }
}

Eigen::VectorXd RigSpread::variance(const Measure& measure) const {
  const Eigen::VectorXd middle = measure(likeliest_);
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(middle.size());
  for (std::size_t i = 0; i < above_.size(); ++i)
    noise += (0.5 * (measure(above_[i]) - measure(below_[i]))).cwiseAbs2();
  if (!slips_ || without_.size() < 2) return noise;
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(middle.size());
  for (const bundle::Problem& one : without_) spread += (measure(one) - middle).cwiseAbs2();
  const double views = double(without_.size());
  return noise.cwiseMax((views - 1) / views * spread);
}

}  // namespace relievo::pipeline
