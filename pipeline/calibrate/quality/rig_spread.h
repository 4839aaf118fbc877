// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rigs that the pictures allow beside the likeliest one, and what anything computed from a rig
// varies by among them. Inside calibrate/ only. Thread: any.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "pipeline/calibrate/fit/stereo_fit.h"
#include "pipeline/calibrate/quality/uncertainty.h"

namespace relievo::pipeline {

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

// Of distances alone (the field of DepthUncertainty at one distance): what a live calibration asks for
// after every view.
DepthUncertainty depth_uncertainty(const RigSpread& spread, double distance_mm);

}  // namespace relievo::pipeline
