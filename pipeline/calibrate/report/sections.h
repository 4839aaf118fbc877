// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the page. Each gives valid HTML. Inside report/ only.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "pipeline/calibrate/report/calibration_report.h"
#include "pipeline/report/page.h"

namespace relievo::pipeline::report {

std::string depth_chart(const CalibrationReport& r);      // uncertainty over distance
std::string rig_plan(const CalibrationReport& r);         // from above, to scale
std::string projection_maps(const CalibrationReport& r);  // heat maps of both cameras
std::string coverage_figure(const CalibrationReport& r);  // where corners were seen
std::string residual_arrows(const CalibrationReport& r);  // at every corner, and their histograms
std::string view_table(const CalibrationReport& r);
std::string number_tables(const CalibrationReport& r);

// What several figures have in common.
inline constexpr double kFigureWidth = 480;
inline constexpr std::array<std::string_view, 2> kCameraNames = {"Left camera", "Right camera"};
inline constexpr std::array<std::string_view, 2> kCameraStyles = {"left", "right"};

// Every which of the corners of one camera to draw: more make no figure clearer, and a page heavy.
std::size_t corner_stride(const CalibrationReport& r);

const CameraIntrinsics& camera_of(const CalibrationReport& r, std::size_t eye);

std::string board_words(const BoardPattern& board);

}  // namespace relievo::pipeline::report
