// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/uncertainty.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "pipeline/calibrate/quality/rig_geometry.h"

namespace relievo::pipeline {
namespace {

constexpr double kFieldStepMm = 80;
constexpr int kMapColumns = 24;
constexpr double kDegrees = 57.29577951308232;

std::vector<Eigen::Vector3d> box(double distance_mm, double step_mm, int layers) {
  std::vector<Eigen::Vector3d> points;
  for (int z = 0; z < layers; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        points.emplace_back(x * step_mm, y * step_mm, distance_mm + (z - layers / 2) * step_mm);
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
  std::vector<bundle::Pose> rays;
  const auto pixels = [](const CameraIntrinsics& c, const std::vector<bundle::Pose>& of) {
    Eigen::VectorXd at(2 * static_cast<Eigen::Index>(of.size()));
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Vec2d p = bundle::project(c, of[i], 0, 0);
      at.segment<2>(2 * static_cast<Eigen::Index>(i)) << p.x, p.y;
    }
    return at;
  };
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      bundle::Pose ray;
      ray.translation_mm = ray_of(camera, {(column + 0.5) * camera.width_px / map.columns - 0.5,
                                           (row + 0.5) * camera.height_px / map.rows - 0.5});
      rays.push_back(ray);
    }
  const Eigen::VectorXd middle = pixels(camera, rays);
  Eigen::MatrixX3d by_turn(middle.size(), 3);
  constexpr double kTurn = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<bundle::Pose> turned = rays;
    const Eigen::Matrix3d turn = bundle::rotation_of(kTurn * Eigen::Vector3d::Unit(axis));
    for (bundle::Pose& ray : turned) ray.translation_mm = turn * ray.translation_mm;
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

DepthUncertainty depth_uncertainty(const RigSpread& spread, double distance_mm) {
  const Probes probes = probes_of(spread.likeliest(), box(distance_mm, kFieldStepMm, 1));
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
  const Probes probes = probes_of(spread.likeliest(), box(working_distance_mm, kFieldStepMm, 3));
  const Cloud reference = cloud_of(spread.likeliest(), probes);
  const Eigen::VectorXd scale = spread.variance([&](const bundle::Problem& rig) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, scale_between(reference, cloud_of(rig, probes)));
  });
  u.scale_percent = 100 * std::sqrt(scale[0]);
  const Eigen::VectorXd shape = spread.variance(
      [&](const bundle::Problem& rig) { return flat(shape_difference(cloud_of(rig, probes), reference)); });
  u.shape_sigma_mm = std::sqrt(3 * shape.mean());
  u.parameters = parameter_uncertainty(spread);
  return u;
}

}  // namespace relievo::pipeline
