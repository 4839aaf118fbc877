// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far two records of the same pictures lie from each other: matches and points by the pixel of the left
// view they belong to, the surfaces by the nearest point. Thread: any.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/bench/chain/chain_record.h"

namespace relievo::bench {

struct Spread {                                     // of the sizes of differences
  double median = 0, most_of_all = 0, largest = 0;  // most_of_all: 99.9 % lie within
};

Spread spread_of(std::vector<double> sizes);

struct ChainDifference {
  bool identical = false;                      // every byte
  double grey_levels = 0;                      // the largest of the rectified views
  std::size_t matches = 0, matches_alone = 0;  // accepted by both; by one alone
  Spread disparity_px, disparity_sigmas;
  std::size_t points = 0, points_alone = 0;
  Spread point_mm, point_sigmas;
  Spread surface_mm;        // of the second's vertices from the first's surface
  double colour_share = 0;  // of the texture's bytes differ, where it has the same size; 1 otherwise

  std::string text() const;
};

ChainDifference between(const ChainRecord& a, const ChainRecord& b);

}  // namespace relievo::bench
