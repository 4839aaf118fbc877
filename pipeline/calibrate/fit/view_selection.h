// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which views agree on where the right camera stands. Inside calibrate/ only.
//
// A pair of pictures in which both cameras hold still adds six numbers of freedom (the board's pose)
// less than two cameras alone would need: its excess, the sum of squares with the rig rigid minus
// the sum with each camera alone, is noise * chi-square of 6. Views that moved have more.
//  1. The half of the views with the least excess together (least trimmed squares with concentration
//     steps, Rousseeuw and Van Driessen 2006), started from the relation each view alone suggests.
//  2. Forward search (Atkinson and Riani 2000): the view whose admission costs least is let in as long
//     as its cost is no surprise (F test of 6 degrees of freedom against the views already in).
//  3. Where a lasting change is found along the sequence, only the side with more of them is used.
// The yardstick is the spread of the agreeing views themselves, never less than the corner noise: on
// a rig that shakes, shaking is normal, and what is left out is what stands out of that.
#pragma once

#include <span>
#include <vector>

#include "pipeline/calibrate/fit/stereo_fit.h"

namespace relievo::pipeline {

// Where a lasting change of disagreement lies: index into the excesses of the last view before it,
// with the range a likelihood ratio at 1 % leaves open; -1 without one.
struct ChangePoint {
  int likeliest = -1;
  int first = -1;
  int last = -1;
};

struct Selection {
  StereoFit fit;               // of the views used
  std::vector<double> excess;  // one a pair given, px² summed, under the fit they were chosen by
  ChangePoint moved;           // by place among the pairs; only one side of it is used
  double spread_px2 = 0;       // excess of the used views for one degree of freedom
};

bool select_views(const CalibratorInput& input, const CameraFits& cameras, std::span<const int> pairs,
                  Selection& out);

// Does the pairs' disagreement look more like a board that was carried on between the two exposures than like
// a right camera that turned about its own centre in every view? Three numbers of freedom a view, the
// relation fitted anew under either story.
bool board_carried_on(const CameraFits& cameras, std::span<const int> pairs,
                      const bundle::Pose& right_from_left);

}  // namespace relievo::pipeline
