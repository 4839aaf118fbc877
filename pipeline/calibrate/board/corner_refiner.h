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

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

#include "hal/base/image_view.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// The picture of a chessboard's corner as a function of thirteen numbers, and one step of its least
// squares fit. Inside corner_refiner only. Pixels; origin in the middle of the window.

// Pixels that take part, as columns of equal length, padded with weightless ones to whole lanes.
struct CornerWindow {
  static constexpr std::size_t kLanes = 16;
  std::vector<float> x, y, value, weight;
  std::vector<unsigned char> strip;  // 0 to 7: which half edge, which side of it
  float reach_px = 0;                // unit of the light's slope

  std::array<std::vector<float>*, 4> columns() { return {&x, &y, &value, &weight}; }
  std::size_t count() const { return strip.size(); }  // without the padding
};

// brightness = light + swing q + tone q²,  q = F(s1 / width1) F(s2 / width2): s1, s2 the distances
// from the two edges, F a blurred step; light and swing linear in x and y. q > 0 where both s > 0.
struct CornerModel {
  enum Index {
    X,
    Y,
    Angle1,
    Angle2,
    Width1,
    Width2,
    Light,
    LightX,
    LightY,
    Swing,
    SwingX,
    SwingY,
    Tone,
    Count
  };
  static constexpr int kShapes = Light;  // the first six enter nonlinearly
  std::array<float, Count> p{};
};

using CornerMatrix = Eigen::Matrix<double, CornerModel::Count, CornerModel::Count>;
using CornerVector = Eigen::Matrix<double, CornerModel::Count, 1>;

struct CornerSums {
  CornerMatrix information;            // of all parameters
  CornerVector slope;                  // towards the minimum
  double squared = 0;                  // sum of squared residuals
  std::array<double, 8> strip_mean{};  // of the residuals
  std::array<double, 8> strip_count{};
};

struct CornerGuess {
  Vec2d at;         // px
  Vec2d along_row;  // to the next corner of the row and of the column, px
  Vec2d along_column;
  bool dark = false;  // the square between the two
};

struct CornerFit {
  Vec2d at;           // px
  double middle = 0;  // grey level between dark and bright
  double swing = 0;   // half of bright minus dark; 0 where no corner is seen
  bool seen() const { return swing > 0; }
};

class CornerRefiner {
 public:
  // `clear_share`: how far from an edge the squares are certainly plain, as a share of a square;
  // markers begin there. The picture must outlive this.
  CornerRefiner(const ImageView& picture, double clear_share)
      : picture_(picture), clear_share_(clear_share) {}

  // Unseen where there is no such corner, or none that can be trusted.
  CornerFit refine(const CornerGuess& guess);

 private:
  bool gather(const CornerGuess& guess, const Vec2d& at);
  bool solve(bool coarse);
  // Into sums_. The information is left as it was where only the slope is asked for.
  void sum_up(bool information);
  double step_all();
  bool plausible(const CornerGuess& guess) const;
  CornerFit judged(const CornerGuess& guess, const Vec2d& at) const;

  ImageView picture_;
  double clear_share_;
  std::array<float, 2> first_angle_{};
  CornerModel model_;
  CornerWindow window_;                                             // these two are kept for their memory
  std::array<std::vector<float>, CornerModel::Count + 1> scratch_;  // columns that the sums need
  CornerSums sums_;
};

}  // namespace relievo::pipeline
