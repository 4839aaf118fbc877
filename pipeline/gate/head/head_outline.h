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

}  // namespace relievo::pipeline
