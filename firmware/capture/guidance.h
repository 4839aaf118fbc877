// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Guidance: what the person at the screen is told about where they stand, with one live picture. Plain data.
#pragma once

#include <bitset>
#include <optional>

#include "pipeline/model/advice.h"

namespace relievo::firmware {

// Of a head that turns after the frontal picture.
struct TurnGuidance {
  pipeline::TurnAdvice advice = pipeline::TurnAdvice::Lost;
  double yaw_deg = 0;  // against the front, + to the picture's right
  std::bitset<pipeline::kSides> taken;
};

struct Guidance {
  pipeline::Advice advice = pipeline::Advice::NoFace;
  double face_x = 0, face_y = 0;  // of the face from the middle of where it should be, in widths of a face:
                                  // the picture's right, down
  double ideal_width = 0;  // of a face at the best distance, share of the picture's width; 0: not known
  double nearness = 0;     // 1 at a good distance, 0.5 twice as far, 2 half as far; 0: not known
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;  // of the head: pipeline/gate/head/head_measurement.h
  double steady_s = 0;                              // so long no picture has had a reason
  double focus_share =
      0;  // for a hand at the lens: sharpness against the sharpest of this visit; 0: not measured
  std::optional<TurnGuidance> turn;
};

}  // namespace relievo::firmware
