// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a rig of the bundle adjustment makes of pixels: rays, points, clouds of probes.
// Frames: left camera, millimetres. Inside calibrate/ only. Thread: any.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "pipeline/calibrate/fit/bundle.h"
#include "pipeline/calibrate/fit/stereo_fit.h"
#include "pipeline/calibrate/quality/quality.h"

namespace relievo::pipeline {

// On the plane z = 1 of the camera.
Eigen::Vector3d ray_of(const CameraIntrinsics& camera, const Vec2d& at);

// The point nearest to both lines of sight.
Eigen::Vector3d point_of(const bundle::Problem& rig, const Vec2d& left, const Vec2d& right);

// Sum of squared distances (px of the right camera) of right corners from the epipolar lines of the
// left ones; counts them.
double epipolar_squared(const bundle::Problem& rig, const BoardCorners& left, const BoardCorners& right,
                        int& count);

// Nine points of the field of DepthUncertainty at a distance.
std::vector<Eigen::Vector3d> depth_field(double distance_mm);

// Points of the field as pixels of both pictures: what another rig makes of them is its error.
struct Probes {
  std::vector<Vec2d> left;
  std::vector<Vec2d> right;
};
Probes probes_of(const bundle::Problem& rig, const std::vector<Eigen::Vector3d>& points);

using Cloud = Eigen::Matrix3Xd;
Cloud cloud_of(const bundle::Problem& rig, const Probes& probes);

// By how much `from` must be scaled to be as large as `to`.
double scale_between(const Cloud& from, const Cloud& to);

// The rigs that the pictures allow beside the likeliest one, and what anything computed from a rig
// varies by among them.
class RigSpread {
 public:
  // slips: let the paired views' own spread count, where it is larger than their covariance says.
  RigSpread(const StereoFit& fit, bool slips);

  using Measure = std::function<Eigen::VectorXd(const bundle::Problem&)>;
  Eigen::VectorXd variance(const Measure& measure) const;

  // Fits without one paired view each, in the order of fit.paired.
  const std::vector<bundle::Problem>& without() const { return without_; }
  const bundle::Problem& likeliest() const { return likeliest_; }
  bool slips() const { return slips_; }

 private:
  bundle::Problem likeliest_;
  std::vector<bundle::Problem> above_;  // one for each direction of the covariance, one sigma out
  std::vector<bundle::Problem> below_;
  std::vector<bundle::Problem> without_;
  bool slips_;
};

CalibrationUncertainty measure_uncertainty(const RigSpread& spread, double working_distance_mm);

DepthUncertainty depth_uncertainty(const RigSpread& spread, double distance_mm);

}  // namespace relievo::pipeline
