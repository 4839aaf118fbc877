// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadMeasurement: where a head is and how it is held, from the relief alone, once somebody says roughly
// where a face is.
//
// Yaw and roll are those of the plane in which the face mirrors itself best (a face is symmetric, whoever it
// is); pitch is the slope of the face in that plane, less what that slope is on the average head. All are
// measured from a head that faces the middle between the cameras, wherever it stands:
//   yaw    + turned to the picture's right (the person's left)
//   pitch  + looks down
//   roll   + the crown leans to the picture's left (the person's right shoulder)
// Frame of points: that of the relief. Memory: scratch. Thread: any; deterministic. Errors: none; known is
// false where there is no head.
#pragma once

#include <array>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/model/relief.h"

namespace relievo::pipeline {

// Right, down and away of a head that faces the middle between the cameras from where it is.
struct HeadAxes {
  Vec3d right, down, away;
};
HeadAxes axes_facing_the_rig(const Vec3d& at, double baseline_mm);

struct HeadMeasurement {
  bool known = false;
  Vec3d tip_mm;  // of the nose
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  double asymmetry_mm = 0;    // rms between the face and its mirror image, limited to 12 mm a point
  double relief_mm = 0;       // how far the nose stands out before the cheeks: what a flat picture has not
  double in_front_share = 0;  // of the face: hidden by something nearer than it should be
  double unknown_share = 0;   // of the face: no depth
  Vec3d right, down,
      away;  // the head's axes in the relief's frame, unit: the picture's right, down, into the head
};

struct HeadHint {
  Vec2d centre_px;      // of the face, between eyes and mouth
  double width_px = 0;  // about 150 mm
};

HeadMeasurement measure_head(const Relief& relief, const HeadHint& hint, StageContext& context);

// Where on the picture a place of the face lies: millimetres from the tip of the nose along right and down,
// on the surface the relief shows there.
struct FacePlace {
  int x = 0, y = 0;
  bool inside = false;
};
FacePlace place_on(const Relief& relief, const HeadMeasurement& head, double right_mm, double down_mm);

}  // namespace relievo::pipeline
