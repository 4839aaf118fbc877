// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StatisticalConstraint ("statistical"): a match must not stand out from the others, by robust statistics
// (median and median absolute deviation, Huber 1981; the dissertation's statistical constraint uses mean and
// standard deviation, which the outliers themselves move). Two rules, each off at 0:
//   global  |d - median of all d|     <= global_sigmas * 1.4826 MAD of all
//   local   |d - median of neighbours| <= local_sigmas * max(1.4826 MAD of the neighbours, floor_px)
// Neighbours are the accepted matches no further than radius_px across and down, the match itself not; fewer
// than five say nothing and the match stays. What earlier rules rejected has no vote; what this one rejects
// has.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/match/kinds.h"

namespace relievo::pipeline {

struct StatisticalConstraint {
  float global_sigmas = 6;
  float local_sigmas = 4;
  float radius_px = 10;
  float floor_px = 0.5F;  // neighbours that agree better than this do not make the rule stricter

  void describe(auto&& field) {
    field("global_sigmas", global_sigmas, OptionRange{0, 100},
          "distance from the median of all disparities, in their scatter; 0: any");
    field("local_sigmas", local_sigmas, OptionRange{0, 100},
          "distance from the median of the neighbours, in their scatter; 0: any");
    field("radius_px", radius_px, OptionRange{1, 256}, "how far neighbours reach, pixels");
    field("floor_px", floor_px, OptionRange{0.01, 64},
          "least scatter the neighbours are taken to have, pixels");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

}  // namespace relievo::pipeline
