// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a corner of a chessboard is, by least squares: two blurred straight edges that cross, each
// with a direction and a blur of its own, under a light that falls off across the window, through a
// camera's tone curve, are fitted to the pixels along the edges. The corner's position, its standard
// deviation and whether the pixels look like a corner at all come out of one fit.
// Unlike methods on gradients it takes every pixel for what it is worth, so noise and blur cost no
// more than they must. Inside calibrate/board/ only. Thread: one at a time.
#pragma once

#include <array>
#include <optional>

#include "pipeline/calibrate/board/corner_model.h"
#include "pipeline/calibrate/board/grey_pyramid.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct CornerGuess {
  Vec2d at;         // px
  Vec2d along_row;  // to the next corner of the row and of the column, px
  Vec2d along_column;
  bool dark = false;  // the square between the two
};

struct CornerFit {
  Vec2d at;
  double sigma_px = 0;  // of either coordinate, the larger
  double middle = 0;    // grey level between dark and bright
  double swing = 0;     // half of bright minus dark, positive
};

class CornerRefiner {
 public:
  // `clear_share`: how far from an edge the squares are certainly plain, as a share of a square;
  // markers begin there. The picture must outlive this.
  CornerRefiner(const GreyView& picture, double clear_share) : picture_(picture), clear_share_(clear_share) {}

  const GreyView& picture() const { return picture_; }
  // No value where there is no such corner, or none that can be trusted.
  std::optional<CornerFit> refine(const CornerGuess& guess);

 private:
  bool gather(const CornerGuess& guess, const Vec2d& at);
  bool solve(bool coarse);
  void step_linear();
  double step_all();
  bool plausible(const CornerGuess& guess) const;
  std::optional<CornerFit> judged(const CornerGuess& guess, const Vec2d& at) const;

  GreyView picture_;
  double clear_share_;
  std::array<float, 2> first_angle_{};
  CornerModel model_;
  CornerWindow window_;  // these two are kept for their memory
  CornerScratch scratch_;
  CornerSums sums_;
};

}  // namespace relievo::pipeline
