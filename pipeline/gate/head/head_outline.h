// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the outline of somebody near tells where the face itself tells nothing: of whom no cascade sees a
// face, where a head may be; of a head of which hardly more than a cheek is seen, to which side it looks.
// Frame: that of the relief. Memory: none. Thread: any; deterministic. Errors: none.
#pragma once

#include "pipeline/gate/head/head_measurement.h"

namespace relievo::pipeline {

struct Somebody {
  // How far from the picture's middle, in shares of its width and height; 0: not clearly, or nobody.
  double right = 0, down = 0;
  HeadHint head;  // width_px is 0 where there is nobody
};
// `farthest_mm`: where the capture volume ends.
Somebody find_somebody(const Relief& relief, double farthest_mm);

// A nose stands before the axis of its head: a head that is turned has it beside the middle of its outline.
// Within 15 degrees of the true yaw where the tip is right; where a cheek was taken for it too little, but of
// the same sign. Signs: HeadMeasurement. 0: no outline.
double outline_yaw_deg(const Relief& relief, const Vec3d& tip_mm);

// Something before a face: a hand, a sheet, hair that hangs down. Asked before the head itself is measured,
// since of a covered face neither tip nor pose can be told.
// Share of the face about the hint that lies on surfaces which stand before another surface of it: they meet
// along kLeastMeetingMm or more, and the nearer is nearer by kStepMm or more all along. The face before its
// own neck, ear or the room is not meant.
double covered_share(const Relief& relief, const HeadHint& hint);

inline constexpr double kStepMm = 15, kLeastMeetingMm = 25;

// Something beside the head at the depth of the face: somebody else's head that no cascade knows for a face,
// a hand, a bag. What is matched and measured there would be taken for a part of this person. What lies
// behind the head, however cluttered, is cut away by its depth and does no harm.
// Of two fields beside the head, level with the face, kBesideInnerMm to kBesideOuterMm aside from the tip of
// the nose, the share of the fuller one that something stands in, from kBesideBeforeMm before the tip to
// kBesideBehindMm behind it. Surfaces that reach into the head are its own (hair, a hat, its back when it is
// turned), up to three fifths of the field: a bag held against the head grows into one surface with it.
double beside_share(const Relief& relief, const HeadMeasurement& head);

inline constexpr double kBesideInnerMm = 110, kBesideOuterMm = 180, kBesideBeforeMm = 120,
                        kBesideBehindMm = 150;

}  // namespace relievo::pipeline
