// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keypoint: a place in the left rectified view worth matching. Match: where it appears in the right one, on
// the same row.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct Keypoint {
  Vec2f at_px;
  float strength = 0;
};

struct Keypoints {
  explicit Keypoints(std::pmr::memory_resource* memory) : points(memory) {}
  std::pmr::vector<Keypoint> points;
  // Keypoints on a regular lattice (row by row, step_px apart) keep their neighbourhood for dense
  // matchers and grid meshers; 0 where they are scattered.
  int lattice_step_px = 0;
};

struct Match {
  Vec2f left_px;
  float disparity_px = 0;
  float cost = 0;      // 0 perfect .. 1 unrelated: 1 - zero-mean correlation where the matcher has one
  float sigma_px = 0;  // one standard deviation of disparity_px
  std::uint16_t rejected_by = 0;  // bit n: constraint n of the set; 0 means accepted
};

// How far the rows of the two views are from agreeing on the face's own texture, before any
// realignment: offset + slope_x (x - middle_x) + slope_y (y - middle_y). Full-size rectified pixels of
// the right view. An error along the rows does not show here: it changes the depth, not the likeness.
struct EpipolarShift {
  double offset_px = 0;  // in the middle of the face; positive: the right partner lies lower
  double slope_x = 0;    // px per px across, as when a camera is rolled
  double slope_y = 0;    // and down
  double middle_x_px = 0;
  double middle_y_px = 0;
  double spread_x_px = 1;  // standard deviation of the face's points about the middle
  double spread_y_px = 1;
  double correlation = 0;  // of x and y over the face
  // Of (offset_px, slope_x * spread_x_px, slope_y * spread_y_px), px^2: 00 01 02 11 12 22.
  std::array<double, 6> covariance_px2{};
  double residual_px = 0;  // rms of the shift over the face
  double sigma_px = 0;     // rms over the face of its standard deviation; 0: nothing was measured

  bool measured() const { return sigma_px > 0; }
  double at(double x, double y) const {
    return offset_px + slope_x * (x - middle_x_px) + slope_y * (y - middle_y_px);
  }
};

struct MatchSet {
  explicit MatchSet(std::pmr::memory_resource* memory) : matches(memory) {}
  std::pmr::vector<Match> matches;
  EpipolarShift epipolar_shift;  // measured by `refined`
  double motion_px = 0;     // rms over the face of what moved across the rows between the exposures, beside
                            // the linear shift; 0: nothing was seen. sigma_px of a match has its part of it
  int lattice_step_px = 0;  // as in Keypoints: left_px of accepted and rejected lie on a lattice
};

}  // namespace relievo::pipeline
