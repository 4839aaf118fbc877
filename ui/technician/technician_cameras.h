// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the cameras say while they are watched, and a live calibration from its first pair to its verdict.
// Texts and pictures are borrowed for a frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pipeline/model/live_advice.h"
#include "ui/technician/technician_result.h"
#include "ui/view/list_place.h"

namespace relievo::ui {

struct TechnicianCamera {
  TechnicianPicture picture;
  float mean = 0, clipped = 0;  // of the middle: 1 is white; the share that is burnt out
  float focus = 0;              // how sharp the middle is against the sharpest seen since the watch began
  float sharp_edges = 0;        // the share of the picture that is coloured, because it is in focus
  std::uint64_t frames = 0, lost = 0, damaged = 0;
};
struct TechnicianCameras {
  bool watched = false;
  std::array<TechnicianCamera, 2> camera;  // left, right
  float skew_us = 0, pairs_per_second = 0;
  std::uint64_t pairs = 0, apart = 0;
  float exposure_us = 0;  // as asked for last
  bool can_be_set = false;
  bool relief_shown = false, edges_shown = false;
  TechnicianPicture relief;  // near is bright, black is unknown
  Fault problem;             // why there is no relief
};

inline constexpr std::size_t kCalibrationRows = 6, kCoverageCells = 8;
struct TechnicianCalibrationRow {
  std::uint32_t revision = 0;
  bool active = false;
  std::string_view made_at;
  float depth_error_mm = 0;  // 0: not known
};
struct TechnicianCalibration {
  int columns = 10, rows = 7;
  float square_mm = 20;
  bool charuco = false;
  bool mounted_anew = false;  // the next one may find the cameras at another distance
  bool running = false, ended = false, stored = false;
  std::array<TechnicianPicture, 2> pictures;  // with the corners and the wanted board drawn in
  pipeline::LiveAdvice advice = pipeline::LiveAdvice::ShowBoard;
  pipeline::LiveEnd end = pipeline::LiveEnd::NotYet;
  int views = 0, disagreeing = 0;
  std::array<float, 4> bars{};  // across, down, size, tilt: 0 to 1
  std::array<std::array<std::uint32_t, kCoverageCells * kCoverageCells>, 2>
      seen{};                       // corners in each part of the pictures, row by row
  float error_mm = 0, goal_mm = 0;  // predicted, of distances, one standard deviation
  pipeline::CalibrationVerdict verdict = pipeline::CalibrationVerdict::Refuse;  // once it has ended
  float depth_error_mm = 0, rms_px = 0, baseline_mm = 0;
  std::span<const float> views_px;  // disagreement with the board, each view of the fit; rms of both cameras
  std::span<const std::string> reasons;  // why it is good, doubted or refused, most important first; English
  std::string_view exported;             // the folder on the stick; empty: none was
  Fault problem;                         // what went wrong
  std::array<TechnicianCalibrationRow, kCalibrationRows> history{};
  std::size_t history_count = 0;  // of a page
  ListPlace place;
};

}  // namespace relievo::ui
