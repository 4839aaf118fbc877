// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Follows a board through one camera's pictures at little cost: it looks in a reduced picture, first
// where the board was last time; at full size only when asked to.
// Memory: one reduced picture. Thread: one at a time; each camera has its own.
// Errors: find_board()'s own, but for NotFound: no board is a finding.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"
#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::pipeline {

// How sharp a board is in a picture: the distance over which its edges rise from 10 to 90 % of their
// contrast, in pixels. A well focused picture has about 2; motion and defocus widen it, motion in its
// own direction only, so edges along rows and along columns are judged apart and the wider ones count.
// Median over the edges between neighbouring corners; corners to a pixel or so. What is wider than a
// sixth of a square measures as that. 0 where no edge can be measured. Thread: any.
double edge_width_px(const ImageView& picture, const BoardCorners& corners, const BoardPattern& pattern);

struct BoardDetection {
  BoardCorners corners;  // px of the full picture, to a few tenths; empty where the board is not whole
  double edge_px = 0;    // edge_width_px()
};

class BoardTracker {
 public:
  explicit BoardTracker(const BoardPattern& pattern) : pattern_(pattern) {}

  Result<BoardDetection> look(const ImageView& picture);
  // Precise corners of the board that look() has just seen in the same picture; empty where they are
  // not all found.
  Result<BoardCorners> refine(const ImageView& picture) const;

 private:
  void reduce(const ImageView& picture);

  BoardPattern pattern_;
  BoardCorners last_;  // px of the reduced picture
  int factor_ = 1;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<std::uint16_t> means_;
  std::vector<std::byte> grey_;
};

}  // namespace relievo::pipeline
