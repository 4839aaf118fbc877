// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the selectors share: where a keypoint may lie, the peaks of a response, and a choice of the
// strongest that keep their distance. Pixels of the left rectified view; memory: the context's arenas;
// the same result for any number of threads.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/keypoint.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Where a keypoint may lie: in the face region (everywhere where none is marked), and with all pixels
// around it that its response looks at inside the valid picture, whose edge would look like a corner.
class Selectable {
 public:
  Selectable(const RectifiedPair& pair, std::pmr::memory_resource* memory);
  std::size_t count() const { return count_; }  // without any margin
  bool operator()(int x, int y, int margin_px) const;
  // The square from (x, y), `side` pixels wide, is all valid; the region is not asked.
  bool valid_block(int x, int y, int side_px) const;

 private:
  const RectifiedPair& pair_;
  Plane<std::int32_t> valid_above_;  // valid pixels above and left of (x, y)
  std::size_t count_ = 0;
};

// Where every selector but those of a lattice begins.
// Errors: InvalidInput (no pixels), Cancelled, NoFace (nothing selectable).
Result<Selectable> selectable_of(const RectifiedPair& pair, StageContext& context);
Error selection_stopped();  // Cancelled

struct Candidate {
  std::int32_t x, y;
  float strength;
};

// A peak is a pixel that no neighbour within `radius_px` (a square) exceeds, of equal ones the first, with
// more than `least` of the strongest. The strongest are taken first, each at least distance_px from all
// before it, until there are max_points; equal ones from the top left.
struct PeakChoice {
  double least = 0;
  int radius_px = 0;
  double distance_px = 0;
  int max_points = 0;
};

// Divides the response, which is 0 where nothing may be selected, by its greatest; marks the chosen peaks'
// strength in `chosen`. False: cancelled.
bool mark_peaks(Plane<float>& response, const PeakChoice& choice, Plane<float>& chosen,
                StageContext& context);

// What is marked (strength > 0), in rows from the top, at most the max_points strongest.
// Error: TooFewMatches where nothing is.
Result<Keypoints> keypoints_of(const Plane<float>& chosen, int max_points, StageContext& context);
// The chosen peaks of one response. Errors: TooFewMatches, Cancelled.
Result<Keypoints> peak_keypoints(Plane<float>& response, const PeakChoice& choice, StageContext& context);

// First and last pixels of a rectangle of the left view.
struct LatticeArea {
  int left, top, right, bottom;
};

// Every step_px pixels in both directions, from the area's upper left corner on.
// Errors: InvalidInput (no pixels), Cancelled, NoFace.
Result<Keypoints> lattice_keypoints(const RectifiedPair& pair, int step_px, const LatticeArea& area,
                                    StageContext& context);

}  // namespace relievo::pipeline
