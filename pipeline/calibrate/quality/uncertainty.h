// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How wrong a calibration may be, said before anyone is measured with it: the covariance of all its
// parameters carried to what a technician asks for (law of propagation of uncertainty, GUM JCGM
// 100:2008, 5.2; the covariance is that of the bundle adjustment, Triggs et al. 2000).
// One standard deviation everywhere; 95 % of cases lie within 1.96 of it. It holds for corners whose
// errors are independent and for a lens of the model's kind; on a rig that slips between the views
// the spread of the views themselves (jackknife, Efron 1982) takes its place where that is larger.
// Thread: any.
#pragma once

#include <array>
#include <vector>

namespace relievo::pipeline {

// Over a camera's picture, row by row: how far a point's picture may lie from where the calibration
// puts it, what a small turn of the camera would explain set aside (nobody measures by it).
struct ProjectionMap {
  int columns = 0;
  int rows = 0;
  std::vector<double> sigma_px;

  double at(int column, int row) const {
    return sigma_px[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
  }
};

// Of the distance from the left camera, over a field of 160 mm by 160 mm.
struct DepthUncertainty {
  double distance_mm = 0;
  double sigma_mm = 0;        // root mean square over the field
  double worst_sigma_mm = 0;  // at its worst point
};

// Of the calibration's own numbers.
struct ParameterUncertainty {
  std::array<std::array<double, 9>, 2> lens{};  // left, right: fx fy cx cy (px), k1 k2 p1 p2 k3
  std::array<double, 3> turn_deg{};             // of right_from_left's rotation vector
  std::array<double, 3> translation_mm{};
  double baseline_mm = 0;
};

inline constexpr double kTwoSided95 = 1.96;  // standard deviations

inline constexpr int kDepthSteps = 8;
inline constexpr double kFirstDepthMm = 400;
inline constexpr double kDepthStepMm = 50;  // 400, 450 … 750 mm

struct CalibrationUncertainty {
  std::array<ProjectionMap, 2> projection;  // left, right
  std::array<DepthUncertainty, kDepthSteps> depth;
  double scale_percent = 0;   // of lengths in the middle of the field
  double shape_sigma_mm = 0;  // of a head at the boards' distance, laid over the true one
  ParameterUncertainty parameters;
  bool slips = false;  // the spread of the views was larger than the corners' noise explains
};

}  // namespace relievo::pipeline
