// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What somebody who turns their head is told, and which side is photographed when: a pure function of the
// head's turn and of what has been taken. A side is taken when the head stands near it, level, and so slow in
// two pictures in a row that the exposure does not smear it. Angles as HeadTurn; directions are those of the
// left camera's picture, not mirrored.
#pragma once

#include <bitset>
#include <chrono>
#include <optional>

#include "pipeline/gate/turn/head_turn.h"
#include "pipeline/model/advice.h"

namespace relievo::pipeline {

struct TurnLimits {
  double reach_deg = 8;   // of a side: so far from its angle it is still taken
  double level_deg = 12;  // of pitch and roll against the front
  double smear_px = 0.3;  // of a place of the face while the shutter is open, at most
};

struct TurnHistory {
  HeadTurn last;
  std::chrono::nanoseconds last_at{};
  int slow = 0;                      // pictures in a row
  std::optional<std::size_t> asked;  // the side that is led to
  std::bitset<kSides> taken;
};

struct TurnAnswer {
  TurnAdvice advice = TurnAdvice::Lost;
  std::optional<std::size_t> take;  // this picture shows that side: photograph it now
};

// `slow_mm_s`: a place of the face that moves no faster is not smeared.
TurnAnswer guide_turn(const FrontFace& front, const HeadTurn& now, std::chrono::nanoseconds at,
                      double slow_mm_s, const TurnLimits& limits, TurnHistory& history);

}  // namespace relievo::pipeline
