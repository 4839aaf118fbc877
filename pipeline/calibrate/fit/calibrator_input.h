// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a calibration is made from: the corners that were seen, and what is known of the rig beforehand.
// Pixels, millimetres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

inline constexpr int kMinBoardPairs = 5;
inline constexpr int kMaxBoardPairs = 500;

struct BoardView {
  std::string name;
  BoardCorners left;  // empty where no board was found
  BoardCorners right;
};

struct CalibratorInput {
  BoardPattern pattern;
  int width_px = 0;  // of both cameras
  int height_px = 0;
  std::vector<BoardView> views;
  // What the distance of the cameras is known to be, from their mount or the calibration before; 0: unknown.
  // A wrong size of the board's squares cannot be seen without it.
  double expected_baseline_mm = 0;
  // The calibration in use until now, if any: where its lenses are these lenses, its baseline is expected,
  // unless expected_baseline_mm says another.
  std::optional<StereoCalibration> in_use{};
};

}  // namespace relievo::pipeline
