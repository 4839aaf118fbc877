// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a calibration is worth, in numbers and in words.
// Pixels of the pictures as taken; millimetres. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/model/live_advice.h"

// What is good and what cannot be used: the verdict's limits, and what the report says of each figure.
namespace relievo::pipeline::limits {

// Error across the epipolar line: below 0.1 px excellent, above 0.25 px poor by the scale of ROS
// camera_calibration; beyond 0.7 px matching along rows fails.
inline constexpr double kGoodEpipolarPx = 0.15;
inline constexpr double kWorstEpipolarPx = 0.7;
inline constexpr double kGoodShapeMm = 0.3;
inline constexpr double kWorstShapeMm = 3.0;
// Of a face at kFaceMm: predicted, one sigma, and measured on single boards.
inline constexpr double kGoodDepthMm = 0.5;
inline constexpr double kWorstDepthMm = 5.0;
inline constexpr double kGoodCoverage = 0.45;
inline constexpr int kGoodViews = 10;
inline constexpr double kGoodTiltDeg = 15;
inline constexpr double kAlikeDeg = 5;
inline constexpr double kWorstSagMm = 2;
inline constexpr double kFlat = 1e-3;  // sag, of the board's longer side
// Nobody knows a baseline to better than half a per cent without having calibrated it.
inline constexpr double kBaselinePercent = 1.0;
inline constexpr double kUsualPx = 0.15;
inline constexpr double kBlurredPx = 0.4;
inline constexpr double kUselessPx = 1.5;
// Not judged on their own, the shape is: what adds as much to a face 150 mm wide.
inline constexpr double kGoodScalePercent = 100 * kGoodShapeMm / 150;
inline constexpr double kWorstScalePercent = 100 * kWorstShapeMm / 150;

}  // namespace relievo::pipeline::limits

namespace relievo::pipeline {

const char* name_of(CalibrationVerdict verdict);  // pass, usable, refuse

inline constexpr double kFaceMm = 560;  // where faces are

// How wrong a calibration may be, said before anyone is measured with it: the covariance of all its
// parameters carried to what a technician asks for (law of propagation of uncertainty, GUM JCGM
// 100:2008, 5.2; the covariance is that of the bundle adjustment, Triggs et al. 2000).
// One standard deviation everywhere; 95 % of cases lie within 1.96 of it. It holds for corners whose
// errors are independent and for a lens of the model's kind; on a rig that slips between the views
// the spread of the views themselves (jackknife, Efron 1982) takes its place where that is larger.

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

// Why left and right disagree more than corner noise explains.
enum class SlipCause : std::uint8_t {
  None,
  CameraTurns,   // a camera does not hold still
  BoardCarried,  // the board went on between the two exposures: not taken at the same instant
};

struct ViewQuality {
  std::string name;
  bool used = false;       // as a pair
  std::string reason;      // why not, in words and numbers; empty where used
  double left_rms_px = 0;  // reprojection; 0 where the camera has no board
  double right_rms_px = 0;
  double epipolar_rms_px = 0;  // distance of right corners from the lines of the left ones
  double excess_px = 0;        // disagreement of left and right beyond what each camera shows alone
  int corners_dropped = 0;     // single corners that no flat board explains
  double distance_mm = 0;      // of the board's middle from the left camera
  double tilt_deg = 0;         // of the board, from squarely facing the left camera
};

// A root mean square over nothing is not-a-number, and refused: it was not measured.
struct CalibrationQuality {
  CalibrationVerdict verdict = CalibrationVerdict::Refuse;
  std::vector<std::string> reasons;  // most important first
  std::vector<ViewQuality> views;    // all that were given, in their order
  int used = 0;
  double left_rms_px = 0;  // each camera alone, all its boards
  double right_rms_px = 0;
  double pair_rms_px = 0;  // both together, used views
  double epipolar_rms_px = 0;
  double held_out_epipolar_px = 0;  // of views that had no part in the fit (leave-out cross-validation)
  double held_out_shift_px =
      0;  // of these, what a whole board misses them by together: corner noise averages out
  double coverage_left = 0;  // share of an 8 x 8 grid over the picture with a corner of the fit
  double coverage_right = 0;
  bool holds_still = true;  // left and right agree as well as each camera alone allows
  double slip_ratio = 1;    // disagreement over what corner noise explains, 1 for a firm rig
  SlipCause slip_cause = SlipCause::None;
  int moved_after = -1;        // index of the view after which a camera seems to have moved; -1: none
  int moved_after_first = -1;  // the range in which it may as well have been
  int moved_after_last = -1;
  double baseline_mm = 0;
  double expected_baseline_mm = 0;  // what it was said to be; 0: nothing was said
  bool expected_as_in_use = false;  // as the calibration in use says, whose lenses are the same
  double tilt_spread_deg = 0;       // of the boards used: the median angle between two of them
  double board_sag_mm = 0;          // peak to valley, estimated from all views
  double board_sag_sigma_mm = 0;
  bool board_bent = false;         // more than noise and a thousandth of its size explain
  double working_distance_mm = 0;  // median distance of the boards used
  // One standard deviation of a head measured there, as far as this calibration is to blame:
  double depth_sigma_mm = 0;       // of its distance
  double face_depth_sigma_mm = 0;  // the same at 560 mm, where faces are
  double shape_sigma_mm = 0;       // of its shape and size: what stays when it is laid over the true one
  // Measured, on boards that had no part in the fit, against the known size of their squares; root mean
  // squares, depth brought to 560 mm:
  double measured_depth_mm = 0;        // of a whole board
  double measured_point_depth_mm = 0;  // of a single corner, the noise of finding it included
  double measured_length_percent = 0;  // of lengths on the board
  CalibrationUncertainty uncertainty;
};

}  // namespace relievo::pipeline
