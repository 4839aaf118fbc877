// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is good and what cannot be used: the verdict's limits, and what the report says of each figure.
#pragma once

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
