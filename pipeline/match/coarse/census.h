// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The census transform (Zabih and Woodfill, Non-parametric local transforms for computing visual
// correspondence, 1994): which neighbours are darker than a pixel, blind to gain and offset; and what two
// pixels cost that differ in it. Thread: any, on rows of their own.
#pragma once

#include <cstdint>

#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

// One bit a neighbour (9 x 7 without the centre) that is darker than the centre, of rows [begin, end). The
// border, four columns and three rows wide, stays 0.
void census_rows(const Plane<float>& grey, Plane<std::uint64_t>& census, int begin, int end);

struct CensusPair {
  const Plane<std::uint64_t>& from;  // the view the disparity field belongs to
  const Plane<std::uint64_t>& to;
  const Plane<std::uint8_t>& from_valid;
  const Plane<std::uint8_t>& to_valid;
  int sign;  // +1: x_to = x - d (left to right); -1: x_to = x + d
};

// Of every pixel of row y, one after the other, its candidates' costs: the bits in which both views differ
// where it would be found at disparity first[x] + k, and kUnknownCost where one of them knows nothing. Room:
// width * candidates.
inline constexpr std::uint8_t kUnknownCost = 40;  // worse than any chance match (31)
void census_costs(const CensusPair& pair, const std::int16_t* first, int y, int candidates,
                  std::uint8_t* cost);

}  // namespace relievo::pipeline
