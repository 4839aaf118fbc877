// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What somebody who turns their head is told, and which side is photographed when: a pure function of the
// head's turn and of what has been taken. A side is taken when the head stands near it, level, and so slow in
// two pictures in a row that the exposure does not smear it. Angles as HeadTurn; directions are those of the
// left camera's picture, not mirrored.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <optional>

#include "pipeline/gate/head/head_measurement.h"
#include "pipeline/model/advice.h"
#include "pipeline/model/relief.h"

namespace relievo::pipeline {

// HeadTurn: how a head has moved since it was seen from the front, from relief to relief. What the front
// relief shows of the face is laid onto the live one (point to plane; Chen, Medioni 1992, projected as Blais,
// Levine 1995), from where the head was a moment ago or, where that leads nowhere, from heads turned to
// either side. So no symmetry is needed of a face of which one cheek is hidden. Frame: that of the relief;
// angles as HeadMeasurement, against the front: yaw + to the picture's right, pitch + looks down. Plain data
// of fixed size; memory: none. Thread: any; deterministic. Errors: none; known is false where the head was
// not found.

// The face as it was seen from the front.
struct FrontFace {
  static constexpr std::size_t kMost = 1500;
  struct Point {
    Vec3d at_mm, normal;
  };
  std::array<Point, kMost> points{};
  std::size_t count = 0;  // 0: there is none
  Vec3d pivot_mm;         // about the middle of the head
  Vec3d right, down, away;
};
// Of a head that was measured in this relief. Into `face`: too large for a stack.
void front_face(const Relief& relief, const HeadMeasurement& head, FrontFace& face);

struct HeadTurn {
  bool known = false;
  RigidTransform now_from_front;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  double met_share = 0;  // of the face's visible surface: lies on the live one
};
HeadTurn follow_head(const FrontFace& front, const Relief& relief, const HeadTurn& before);

// The furthest any place of the face moved between two, mm.
double moved_mm(const FrontFace& front, const HeadTurn& from, const HeadTurn& to);

inline constexpr double kMostSmearPx = 0.3;  // of a place of the face while the shutter is open

struct TurnHistory {
  HeadTurn last;
  std::chrono::nanoseconds last_at{};
  TurnAdvice advice = TurnAdvice::Lost;  // the last one
  int slow = 0;                          // pictures in a row
  std::optional<std::size_t> asked;      // the side that is led to
  double nearest_deg = 0;                // to it, so far
  std::chrono::nanoseconds nearer_at{};
  std::bitset<kSides> taken, given_up;  // given up: of a hand that did not come; for a while
};

struct TurnAnswer {
  TurnAdvice advice = TurnAdvice::Lost;
  std::optional<std::size_t> take;  // this picture shows that side: photograph it now
};

// `slow_mm_s`: a place of the face that moves no faster is not smeared.
TurnAnswer guide_turn(const FrontFace& front, const HeadTurn& now, std::chrono::nanoseconds at,
                      double slow_mm_s, TurnHistory& history);

}  // namespace relievo::pipeline
