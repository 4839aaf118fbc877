// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much of what a camera can be shown it has been shown: four bars and a map.
//
// The bars are those of ROS camera_calibration, 0 to 1: the range of x and of y over the views taken
// (1 at a range of 0.7), the largest size (1 at 0.4) and the largest skew (1 at 0.5); board_parameters.h
// says what these are. Thread: any.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/calibrate/live/watch/board_parameters.h"

namespace relievo::pipeline {

struct CoverageBars {
  double x = 0;
  double y = 0;
  double size = 0;
  double skew = 0;

  double least() const;
};

// Of two cameras a bar is as full as the emptier one's.
CoverageBars lesser(const CoverageBars& a, const CoverageBars& b);

inline constexpr int kCoverageColumns = 8;
inline constexpr int kCoverageRows = 8;

// Corners seen in each cell of the picture, row by row.
struct CoverageMap {
  std::array<std::uint32_t, kCoverageColumns * kCoverageRows> count{};

  std::uint32_t at(int column, int row) const {
    return count[static_cast<std::size_t>(row) * kCoverageColumns + static_cast<std::size_t>(column)];
  }
  double share() const;  // of the cells with a corner
};

class Coverage {
 public:
  void add(const BoardCorners& corners, const BoardParameters& parameters, int width_px, int height_px);

  CoverageBars bars() const { return bars_of(range_); }
  CoverageBars bars_with(const BoardParameters& one_more) const;
  const CoverageMap& map() const { return map_; }

 private:
  struct Range {
    double low_x = 1, high_x = 0, low_y = 1, high_y = 0, size = 0, skew = 0;
    void widen(const BoardParameters& by);
  };
  static CoverageBars bars_of(const Range& range);

  Range range_;
  CoverageMap map_;
};

}  // namespace relievo::pipeline
