// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadTurn: how a head has moved since it was seen from the front, from relief to relief. What the front
// relief shows of the face is laid onto the live one (point to plane; Chen, Medioni 1992, projected as Blais,
// Levine 1995), from where the head was a moment ago or, where that leads nowhere, from heads turned to
// either side. So no symmetry is needed of a face of which one cheek is hidden. Frame: that of the relief;
// angles as HeadMeasurement, against the front: yaw + to the picture's right, pitch + looks down. Plain data
// of fixed size; memory: none. Thread: any; deterministic. Errors: none; known is false where the head was
// not found.
#pragma once

#include <array>
#include <cstddef>

#include "pipeline/gate/head/head_measurement.h"
#include "pipeline/model/relief.h"

namespace relievo::pipeline {

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
// Of a head that was measured in this relief.
FrontFace front_face(const Relief& relief, const HeadMeasurement& head);

struct HeadTurn {
  bool known = false;
  RigidTransform now_from_front;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  double met_share = 0;  // of the face's visible surface: lies on the live one
  double rms_mm = 0;     // of that
};
HeadTurn follow_head(const FrontFace& front, const Relief& relief, const HeadTurn& before);

// The furthest any place of the face moved between two, mm.
double moved_mm(const FrontFace& front, const HeadTurn& from, const HeadTurn& to);

}  // namespace relievo::pipeline
