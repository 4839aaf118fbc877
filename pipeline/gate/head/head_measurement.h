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

// Where the tip of the nose is. What is nearest to the cameras is it only on a head held upright: of a bowed
// one the bridge or the brow is nearer, of one that looks up the chin or a tongue. So it is told by form,
// twice: roughly, as what stands out of the plane that the face about the hint lies in; and, once the axes of
// the head are known, as the peak of its profile along the mirror plane (pronasale: the foremost point of the
// nose on a head held straight, Farkas 1994). Frame: that of the relief, millimetres. Memory: scratch.
// Thread: any; deterministic. Errors: none, false where too little is known.

// By the hint alone. False where the most of the box about it is not known, or is not as wide as a face.
bool rough_tip(const Relief& relief, const HeadHint& hint, StageContext& context, Vec3d& tip);

// Asks of `head` the axes, the pitch and a tip that may be wrong; the new one lies on the surface within
// 14 mm of its mirror plane.
bool tip_of_profile(const Relief& relief, const HeadHint& hint, const HeadMeasurement& head,
                    StageContext& context, Vec3d& tip);

}  // namespace relievo::pipeline
