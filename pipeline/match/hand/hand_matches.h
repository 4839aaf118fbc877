// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Matches made by hand among those that a matcher made. The hand is right: no rule judges its matches, no
// outlier filter takes them away. It cannot leave the pictures or the epipolar line, and beyond the volume or
// the face its points go as all others do.
//
// Scattered matches: the hand's are more of them; a match of the matcher within a window of one goes where
// their disparities differ by more than their distance, which no surface that both cameras see does (Pollard,
// Mayhew, Frisby 1985).
//
// A lattice: the nodes around the place take the hand's disparity. From there the match grows over the
// lattice, best first (Otto and Chau 1989; Lhuillier and Quan 2002), as long as the windows of both views are
// alike at about the neighbour's disparity: over holes, and over matches that differ from it by more than a
// pixel and are less alike, up to matches that agree with it, and to kHandReachMm from the hand's place.
// Where it does not grow the surface around bends to the hand's place: the difference fades out over three
// times its own pixels, within the same reach, and sigma_px has its part of it. So a right match mends a hole
// or a wrong patch, and a wrong one does harm within the reach alone.
//
// Pixels of the rectified pair. Thread: any. Errors of join_by_hand(): InvalidInput (a place outside the
// pictures, "by hand 3": the third), Cancelled; throws std::bad_alloc as every stage does.
#pragma once

#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

inline constexpr double kHandReachMm = 15;

// A new set, on context.scratch. cost and rejected_by of the hand's matches are not asked.
Result<MatchSet> join_by_hand(const RectifiedPair& pair, const MatchSet& matches,
                              std::span<const Match> by_hand, StageContext& context);

// The points that come of the hand's own places, to be put back after a filter has taken some away.
class PointsByHand {
 public:
  PointsByHand(const PointCloud& cloud, std::span<const Match> by_hand, std::pmr::memory_resource* memory);
  void put_back(PointCloud& cloud) const;

 private:
  std::pmr::vector<CloudPoint> points_;
};

}  // namespace relievo::pipeline
