// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is measured of a live pair, the limits it is held against, and the one piece of advice that follows.
// Plain data and a pure function. Directions are those of the left camera's picture, not mirrored; frame of
// points: that of the relief.
#pragma once

#include <array>

#include "hal/base/result.h"
#include "pipeline/gate/expression/expression_measurement.h"
#include "pipeline/gate/head/head_measurement.h"
#include "pipeline/gate/light/face_light.h"
#include "pipeline/model/advice.h"

namespace relievo::pipeline {

struct GateMeasures {
  int faces = 0;         // SingleFacePresent asks for one
  bool tracked = false;  // no cascade sees the face; the relief shows one, where it was a moment ago or where
                         // the outline of somebody has its head
  bool turned_far = false;  // so far that the yaw is that of the outline: head_outline.h
  double guessed_mm = 0;    // distance by a face's width, also of one that the relief does not reach; 0: none
  double picture_dark_share = 0;   // of the whole picture, luminance 0 .. 25
  double middle_bright_share = 0;  // of the middle of the picture, where a face should be: 247 .. 255
  double middle_near_share = 0;    // of the same: by the relief nearer than the capture volume
  // Somebody near whose face is not found: how far from the picture's middle, in shares of its width and
  // height; 0: not clearly, or nobody.
  double somebody_right = 0, somebody_down = 0;
  HeadHint face;             // where on the small picture
  double covered_share = 0;  // of the face, by something that stands before it: head_outline.h
  HeadMeasurement head;
  double off_right_mm = 0, off_down_mm = 0;  // the tip of the nose from the middle of the capture volume
  double speed_mm_s = 0, turn_deg_s = 0;
  FaceLight light;
  double blur_mm = 0;                  // on the face: face_light.h
  std::array<EyeMeasurement, 2> eyes;  // on the picture's left, on its right
  MouthMeasurement mouth;
  double beside_share = 0;  // of a field beside the head, by something else that far away: head_outline.h
};

// A limit is left again only below (or above) a share of it: what was said is not taken back by noise.
struct GateLimits {
  double nearest_mm = 430, farthest_mm = 700;  // the stated capture volume, along the rectified z axis
  double off_right_mm = 60, off_down_mm = 55;
  double yaw_deg = 15, pitch_deg = 13, roll_deg = 15;
  double speed_mm_s = 70, turn_deg_s = 60;
  double darkest_mean = 0.16, brightest_mean = 0.80;  // LuminanceMean; OFIQ's slopes are at 0.2 and 0.8
  double dark_share = 0.45, bright_share = 0.12;
  double side_ratio = 0.40;  // least
  double glossy_share = 0.10;
  double blur_mm = 1.3;  // sharp faces of real cameras measure 0.7 to 1.1
  double covered_share = 0.06, in_front_share = 0.05, unknown_share = 0.45;
  double asymmetry_mm = 5.5;
  double doubtful_mm = 4.7;      // a head turned by less than 20 degrees mirrors itself better
  double relief_mm = 8;          // a nose stands out further: else something flat is before it
  double eye_brightness = 0.62;  // least: darker is behind dark glass
  double iris_contrast = 0.09,
         one_eye_share = 0.2;  // least: of the better seen eye, and of the other one as a share of that: open
  double glare_mm2 = 14;       // of an eye, behind a lamp mirrored in glasses
  double dark_mm2 = 18, steps_mm = 2, before_mm = 4;  // of closed lips
  double rise_mm = 2.0;                               // of the mouth's corners: a smile
  double beside_share = 0.20;
  // Beyond these the relief itself is not to be trusted, and what it says of pose and motion: light and
  // sharpness are asked first.
  double lost_dark_mean = 0.10, lost_bright_share = 0.30, lost_blur_mm = 1.4, lost_below_mm_s = 190;
  double leave = 0.85;        // share of a limit
  double leave_pose = 0.7;    // of place and pose: who stops as soon as they may sways out again
  double leave_sides = 0.96;  // of side_ratio: faces are lit unlike each other in good light, but steadily
};

// The first that holds, in the order of Advice, but for what spoils the measures themselves: hopeless light
// and blur, and something before the face, are asked right after the distance. `said` is what was said of the
// picture before.
Advice judge(const GateMeasures& measures, Advice said);

}  // namespace relievo::pipeline
