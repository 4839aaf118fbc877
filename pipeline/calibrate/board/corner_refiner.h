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
#include <optional>
#include <vector>

#include "pipeline/calibrate/board/grey_pyramid.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// The picture of a chessboard's corner as a function of thirteen numbers, and one step of its least
// squares fit. Inside corner_refiner only. Pixels; origin in the middle of the window.

// Pixels that take part, as columns of equal length, padded with weightless ones to whole lanes.
struct CornerWindow {
  static constexpr std::size_t kLanes = 16;
  std::vector<float> x, y, value, weight;
  std::vector<unsigned char> strip;  // 0 to 7: which half edge, which side of it
  std::size_t count = 0;             // without the padding
  float reach_px = 0;                // unit of the light's slope
  void clear();
  void add(float px, float py, float grey, unsigned char part);
  void pad();
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

// Columns that the sums need; kept between calls so that nothing is allocated anew.
using CornerScratch = std::array<std::vector<float>, CornerModel::Count + 1>;

// The information is left as it was where only the slope is asked for.
void sum_up(const CornerWindow& window, const CornerModel& model, bool information, CornerScratch& scratch,
            CornerSums& sums);

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
