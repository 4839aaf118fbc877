// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a live calibration asks of the person who holds the board, why it ended, and what is left of it.
// Advice is what the person can do; an error is never advice.
//
// Sides are those of the left camera's own picture, not mirrored: Left is towards its column 0, Up
// towards its row 0. A screen that shows the picture mirrored draws Left and Right (and the tilts and
// turns) mirrored, too; it never has to guess whose left is meant.
#pragma once

#include <cstdint>

namespace relievo::pipeline {

enum class LiveAdvice : std::uint8_t {
  ShowBoard,           // neither camera sees it whole
  LeftCameraMissesIt,  // only the right camera sees it whole
  RightCameraMissesIt,
  HoldStill,   // it is where it should be
  TooBlurred,  // it is still, and yet not sharp
  Closer,
  Farther,
  Left,
  Right,
  Up,
  Down,
  TiltLeft,       // its left edge comes nearer
  TiltRight,      // its right edge comes nearer
  TiltForward,    // its upper edge comes nearer
  TiltBack,       // its upper edge goes away
  TurnClockwise,  // about the line of sight, as the picture shows it
  TurnCounterclockwise,
  AlreadyHave,     // still and sharp, but such a view was taken before
  SwappedCameras,  // the left camera stands where the right one should: exchange them, begin again
  Done,
};

enum class LiveEnd : std::uint8_t {
  NotYet,
  GoalReached,  // the predicted error is below the goal, and the bars are full enough
  Plateau,      // no further view would lower the error noticeably, or put a wrong square size right
  Full,         // as many views as the options allow
};

// What a calibration is fit for.
enum class CalibrationVerdict : std::uint8_t { Pass, Usable, Refuse };

}  // namespace relievo::pipeline
