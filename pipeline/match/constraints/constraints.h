// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constraints.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/options.h"

namespace relievo::pipeline {

// SimilarityConstraint ("similarity"): the two views must look alike around a match: its cost (one
// minus zero-mean correlation) stays under a limit.
struct SimilarityConstraint {
  float max_cost = 0.95F;  // plain skin under noise correlates little: only the unrelated go

  void describe(auto&& field) {
    field("max_cost", max_cost, OptionRange{0, 2}, "one minus correlation above which a match is rejected");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

// UniquenessConstraint ("uniqueness"): a place in the right view shows one surface only (Marr and
// Poggio 1976). Where several matches of a row land on the same right pixel, the nearest surface
// hides the others: what lies behind it by more than a margin is rejected.
struct UniquenessConstraint {
  float margin_px = 1.5F;  // a slanted surface may land twice on one pixel

  void describe(auto&& field) {
    field("margin_px", margin_px, OptionRange{0, 64},
          "how far behind another surface a match counts as hidden, pixels");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

// ContinuityConstraint ("continuity"): disparity varies smoothly nearly everywhere (Marr and Poggio
// 1976). On a lattice, a match from which all but a few of its neighbours differ by more than a limit is
// rejected; scattered matches are not judged.
struct ContinuityConstraint {
  float max_step = 2.0F;  // disparity difference per pixel of distance: beyond 63 degrees of slant
  int least_support = 3;  // of the eight neighbours

  void describe(auto&& field) {
    field("max_step", max_step, OptionRange{0.01, 100},
          "disparity difference to a neighbour, pixels per pixel of distance");
    field("least_support", least_support, OptionRange{1, 8}, "how many of the eight neighbours must agree");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

// OrderingConstraint ("ordering"): along a row, points keep their order from view to view (Yuille and Poggio
// 1984). Of every row the largest set of matches that is in order stays (a longest increasing subsequence,
// Fredman 1975), the others are rejected. Thin things before a far background break the order without being
// wrong; a face has none. Scattered matches are judged with those of their row, rounded to whole pixels.
// `slack` lets the right places fall back by that share of the left ones' distance: noise on steep surfaces.
struct OrderingConstraint {
  float slack = 0.1F;  // 0: strict order; a disparity gradient up to 1 + slack along the row is in order

  void describe(auto&& field) {
    field("slack", slack, OptionRange{0, 1},
          "how far right places may fall back, as a share of the left ones' distance");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

// LeftRightConstraint ("left-right"): a match must be found again from the other side (Fua 1993). It works
// for every matcher: the window of the right view at the match is searched for along the left row, by
// zero-mean correlation, at whole pixels within search_px of where the match says, with a parabola between
// them. Where the best place is further from the keypoint than limit_px, or at the end of the search, the
// match is rejected. Matches whose window leaves a picture cannot be asked back and stay.
struct LeftRightConstraint {
  int window_px = 15;  // odd
  int search_px = 8;   // to each side
  float limit_px = 1;

  void describe(auto&& field) {
    field("window_px", window_px, OptionRange{3, 63, 2},
          "side of the window that is searched for, pixels, odd");
    field("search_px", search_px, OptionRange{2, 128}, "how far it is searched for to each side, pixels");
    field("limit_px", limit_px, OptionRange{0.05, 64}, "how far from the keypoint it may be found, pixels");
  }
  void judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px, std::uint16_t bit,
             StageContext& context) const;
};

// StatisticalConstraint ("statistical"): a match must not stand out from the others, by robust statistics
// (median and median absolute deviation, Huber 1981; the dissertation's statistical constraint uses mean and
// standard deviation, which the outliers themselves move). Two rules, each off at 0:
//   global  |d - median of all d|      <= global_sigmas * max(1.4826 MAD of all, floor_px)
//   local   |d - median of neighbours| <= local_sigmas * max(1.4826 MAD of the neighbours, floor_px)
// Neighbours are the accepted matches no further than radius_px across and down, without the match itself; of
// fewer than five it stays. What earlier rules rejected has no vote; what this one rejects has.
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
