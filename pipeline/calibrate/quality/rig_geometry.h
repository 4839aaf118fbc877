// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a rig of the bundle adjustment makes of pixels: rays, points, clouds of probes.
// Frames: left camera, millimetres. Inside calibrate/ only. Thread: any.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline {

// On the plane z = 1 of the camera.
Eigen::Vector3d ray_of(const CameraIntrinsics& camera, const Vec2d& at);

// The point nearest to both lines of sight.
Eigen::Vector3d point_of(const bundle::Problem& rig, const Vec2d& left, const Vec2d& right);

// Sum of squared distances (px of the right camera) of right corners from the epipolar lines of the
// left ones; counts them.
double epipolar_squared(const bundle::Problem& rig, const BoardCorners& left, const BoardCorners& right,
                        int& count);

// Points of the field as pixels of both pictures: what another rig makes of them is its error.
struct Probes {
  std::vector<Vec2d> left;
  std::vector<Vec2d> right;
};
Probes probes_of(const bundle::Problem& rig, const std::vector<Eigen::Vector3d>& points);

using Cloud = Eigen::Matrix3Xd;
Cloud cloud_of(const bundle::Problem& rig, const Probes& probes);

// What is left of the difference when `from` is laid over `to` (rigid motion; one column a point).
Cloud shape_difference(const Cloud& from, const Cloud& to);

// By how much `from` must be scaled to be as large as `to`.
double scale_between(const Cloud& from, const Cloud& to);

}  // namespace relievo::pipeline
