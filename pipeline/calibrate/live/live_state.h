// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a live calibration is asked for, and everything a screen draws of it after the newest pair. Plain
// data, to copy between threads. Pixels of the full pictures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/calibrate/live/watch/board_parameters.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/live_advice.h"

namespace relievo::pipeline {

// What a live calibration is asked for.
struct LiveOptions {
  double goal_mm = 0.1;   // of the predicted error of distances at kFaceMm, one standard deviation
  double full_bar = 0.8;  // what every coverage bar shall reach
  int min_views = 10;
  int max_views = 40;          // bounds memory and time, too
  double plateau_gain = 0.02;  // it ends when no candidate view lowers the predicted error by this share

  double expected_baseline_mm = 0;  // these two as in CalibratorInput
  std::optional<StereoCalibration> in_use{};

  Result<void> check() const;  // InvalidInput
};

// Why a pair of pictures was or was not taken.
enum class PairVerdict : std::uint8_t {
  Taken,
  NoBoard,
  LeftMissesIt,
  RightMissesIt,
  Moving,  // corners moved since the pair before, or there was no board in it
  Blurred,
  AlreadyHave,
  Swapped,
  Finished,  // nothing more is taken
};

const char* name_of(LiveAdvice advice);  // as a person would say it: "tilt left"
// Of several things to change: "closer, lower left, tilt back".
std::string words_of(std::span<const LiveAdvice> way);
const char* name_of(PairVerdict verdict);
const char* name_of(LiveEnd end);

struct LiveState {
  int pairs = 0;                               // seen so far
  PairVerdict verdict = PairVerdict::NoBoard;  // of the newest pair
  LiveAdvice advice = LiveAdvice::ShowBoard;   // what to do now
  double how_far = 0;                          // where it says where to: below 2 is a little, below 4 some
  std::vector<LiveAdvice> way;                 // there, the advice first, then all else that is still off
  std::array<BoardCorners, 2> corners;         // left, right, of the newest pair; empty where not whole
  std::array<double, 2> moved_px{};            // since the pair before; 0 where unknown
  std::array<double, 2> edge_px{};             // how sharp it is
  // Where the wanted board's outer corners would be, once the cameras are roughly known.
  std::optional<std::array<BoardOutline, 2>> wanted;

  int views = 0;        // taken
  int disagreeing = 0;  // of those, left out by the newest calibration
  CoverageBars bars;    // the emptier camera's
  std::array<CoverageMap, 2> maps{};
  double goal_mm = 0;
  double error_mm = 0;  // predicted, one standard deviation; 0 before the first calibration
  LiveEnd end = LiveEnd::NotYet;

  bool done() const { return end != LiveEnd::NotYet; }
};

}  // namespace relievo::pipeline
