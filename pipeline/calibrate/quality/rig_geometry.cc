// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/rig_geometry.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "pipeline/model/calibration.h"

namespace relievo::pipeline {
namespace {

constexpr double kFieldStepMm = 80;
constexpr int kMapColumns = 24;
constexpr double kDegrees = 57.29577951308232;

std::vector<Eigen::Vector3d> box(double distance_mm, int layers) {
  std::vector<Eigen::Vector3d> points;
  for (int z = 0; z < layers; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        points.emplace_back(x * kFieldStepMm, y * kFieldStepMm,
                            distance_mm + (z - layers / 2) * kFieldStepMm);
  return points;
}

Eigen::VectorXd flat(const Cloud& cloud) {
  return Eigen::Map<const Eigen::VectorXd>(cloud.data(), cloud.size());
}

// Pictures of fixed rays, less what the best small turn of the camera explains of their move.
ProjectionMap projection_map(const RigSpread& spread, int eye) {
  const CameraIntrinsics& camera = spread.likeliest().camera[std::size_t(eye)];
  ProjectionMap map;
  map.columns = kMapColumns;
  map.rows = std::max(2, int(std::lround(kMapColumns * double(camera.height_px) / camera.width_px)));
  const auto pixels = [](const CameraIntrinsics& c, const Cloud& rays) {
    Eigen::VectorXd at(2 * rays.cols());
    for (Eigen::Index i = 0; i < rays.cols(); ++i) {
      const Vec2d p = bundle::project(c, rays.col(i));
      at.segment<2>(2 * i) << p.x, p.y;
    }
    return at;
  };
  Cloud rays(3, map.rows * map.columns);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      rays.col(row * map.columns + column) =
          ray_of(camera, {(column + 0.5) * camera.width_px / map.columns - 0.5,
                          (row + 0.5) * camera.height_px / map.rows - 0.5});
  const Eigen::VectorXd middle = pixels(camera, rays);
  Eigen::MatrixX3d by_turn(middle.size(), 3);
  constexpr double kTurn = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d turn = bundle::rotation_of(kTurn * Eigen::Vector3d::Unit(axis));
    Cloud turned = rays;
    for (Eigen::Index i = 0; i < rays.cols(); ++i) turned.col(i) = turn * Eigen::Vector3d(rays.col(i));
    by_turn.col(axis) = (pixels(camera, turned) - middle) / kTurn;
  }
  const Eigen::LDLT<Eigen::Matrix3d> normal((by_turn.transpose() * by_turn).eval());
  const Eigen::VectorXd variance = spread.variance([&](const bundle::Problem& rig) -> Eigen::VectorXd {
    const Eigen::VectorXd moved = pixels(rig.camera[std::size_t(eye)], rays) - middle;
    return moved - by_turn * normal.solve(by_turn.transpose() * moved);
  });
  for (Eigen::Index i = 0; i < variance.size(); i += 2)
    map.sigma_px.push_back(std::sqrt(0.5 * (variance[i] + variance[i + 1])));
  return map;
}

ParameterUncertainty parameter_uncertainty(const RigSpread& spread) {
  const Eigen::VectorXd variance = spread.variance([](const bundle::Problem& rig) -> Eigen::VectorXd {
    Eigen::VectorXd all(2 * bundle::kCameraGlobals + 7);
    const bundle::Pose& relation = rig.right_from_left;
    all << bundle::parameters_of(rig.camera[0]), bundle::parameters_of(rig.camera[1]),
        kDegrees * bundle::turn_of(relation.rotation), relation.translation_mm,
        relation.translation_mm.norm();
    return all;
  });
  ParameterUncertainty u;
  const double* next = variance.data();
  const auto take = [&next](auto& into) {
    for (double& one : into) one = std::sqrt(*next++);
  };
  for (auto& lens : u.lens) take(lens);
  take(u.turn_deg);
  take(u.translation_mm);
  u.baseline_mm = std::sqrt(*next);
  return u;
}

}  // namespace

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
    probes.left.push_back(bundle::project(p.camera[0], point));
    probes.right.push_back(bundle::project(p.camera[1], p.right_from_left * point));
  }
  return probes;
}

Cloud cloud_of(const bundle::Problem& p, const Probes& probes) {
  Cloud cloud(3, static_cast<Eigen::Index>(probes.left.size()));
  for (std::size_t n = 0; n < probes.left.size(); ++n)
    cloud.col(static_cast<Eigen::Index>(n)) = point_of(p, probes.left[n], probes.right[n]);
  return cloud;
}

double scale_between(const Cloud& from, const Cloud& to) {
  const Eigen::Matrix4d lay = Eigen::umeyama(from, to, true);
  return lay.topLeftCorner<3, 3>().col(0).norm();
}

RigSpread::RigSpread(const StereoFit& fit, bool slips)
    : likeliest_(fit.problem),
      without_(bundle::without_each_view(fit.problem, fit.paired.size())),
      slips_(slips) {
  likeliest_.views.clear();  // the globals are what is spread; poses would be copied for nothing
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

std::vector<Eigen::Vector3d> depth_field(double distance_mm) { return box(distance_mm, 1); }

DepthUncertainty depth_uncertainty(const RigSpread& spread, double distance_mm) {
  const Probes probes = probes_of(spread.likeliest(), depth_field(distance_mm));
  const Eigen::VectorXd variance = spread.variance([&](const bundle::Problem& rig) -> Eigen::VectorXd {
    return cloud_of(rig, probes).row(2).transpose();
  });
  return {distance_mm, std::sqrt(variance.mean()), std::sqrt(variance.maxCoeff())};
}

CalibrationUncertainty measure_uncertainty(const RigSpread& spread, double working_distance_mm) {
  CalibrationUncertainty u;
  u.slips = spread.slips();
  for (const int eye : {0, 1}) u.projection[std::size_t(eye)] = projection_map(spread, eye);
  for (int i = 0; i < kDepthSteps; ++i)
    u.depth[std::size_t(i)] = depth_uncertainty(spread, kFirstDepthMm + i * kDepthStepMm);
  const Probes probes = probes_of(spread.likeliest(), box(working_distance_mm, 3));
  const Cloud reference = cloud_of(spread.likeliest(), probes);
  const Eigen::VectorXd scale = spread.variance([&](const bundle::Problem& rig) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, scale_between(reference, cloud_of(rig, probes)));
  });
  u.scale_percent = 100 * std::sqrt(scale[0]);
  const Eigen::VectorXd shape = spread.variance([&](const bundle::Problem& rig) {
    // What is left of the difference when a cloud is laid over the reference by a rigid motion.
    const Cloud cloud = cloud_of(rig, probes);
    const Eigen::Matrix4d lay = Eigen::umeyama(cloud, reference, false);
    return flat(
        ((lay.topLeftCorner<3, 3>() * cloud).colwise() + Eigen::Vector3d(lay.topRightCorner<3, 1>())) -
        reference);
  });
  u.shape_sigma_mm = std::sqrt(3 * shape.mean());
  u.parameters = parameter_uncertainty(spread);
  return u;
}

}  // namespace relievo::pipeline
