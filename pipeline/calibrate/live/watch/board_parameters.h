// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where and how a board lies in one camera's picture, in a few numbers that need no calibration. Thread: any.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::pipeline {

// The four outermost inner corners, in the order of the board: first, end of the first row, last,
// begin of the last row. Where such a corner was not seen it follows from the others.
using BoardOutline = std::array<Vec2d, 4>;
BoardOutline outline_of(const BoardCorners& corners, const BoardPattern& pattern);
// With the squares around the outer corners, about: what a picture must hold for the board to be found.
BoardOutline with_border(const BoardOutline& outline, const BoardPattern& pattern);

struct BoardParameters {
  // As the users of ROS camera_calibration know them, 0 to 1.
  double x = 0;  // middle of the corners; 0 and 1: as far out as half a board's size from the edge
  double y = 0;
  double size = 0;  // root of the board's share of the picture
  double skew = 0;  // twice the angle (rad) by which its second corner differs from a right one, at most 1

  // What ROS leaves out, and what a person is told to change.
  double across = 0;  // middle of the outline, shares of width and height
  double down = 0;
  double tilt_across = 0;  // of its normal, the part to the side, exact for a focal length of 1.5 pictures'
                           // width; above 0 the edge on the picture's left is nearer than the right one
  double tilt_down = 0;    // the part up or down; above 0 the upper edge is nearer than the lower one
  double turn_rad = 0;     // clockwise, of the edge that is the upper one; within an eighth of a circle
};

BoardParameters parameters_of(const BoardCorners& corners, const BoardPattern& pattern, int width_px,
                              int height_px);

// How much two views differ: the sum of differences in x, y, size and skew, as in ROS, and 0.7 of those
// in the tilts, without which views that determine the focal length would count as repetitions.
double distance_between(const BoardParameters& a, const BoardParameters& b);

// How much of what a camera can be shown it has been shown: four bars and a map.
//
// The bars are those of ROS camera_calibration, 0 to 1: the range of x and of y over the views taken
// (1 at a range of 0.7), the largest size (1 at 0.4) and the largest skew (1 at 0.5); board_parameters.h
// says what these are. Thread: any.
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
using CoverageMap = std::array<std::uint32_t, kCoverageColumns * kCoverageRows>;

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
  CoverageMap map_{};
};

}  // namespace relievo::pipeline
