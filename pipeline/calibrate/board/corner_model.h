// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picture of a chessboard's corner as a function of thirteen numbers, and one step of its least
// squares fit. Inside corner_refiner only. Pixels; origin in the middle of the window.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace relievo::pipeline {

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
struct CornerScratch {
  std::array<std::vector<float>, CornerModel::Count + 1> column;
};

// The information is left as it was where only the slope is asked for.
void sum_up(const CornerWindow& window, const CornerModel& model, bool information, CornerScratch& scratch,
            CornerSums& sums);

}  // namespace relievo::pipeline
