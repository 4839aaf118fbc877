// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Order statistics: one of the values, never one made up between two. The values are put in another order; of
// none it is not a number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>

namespace relievo {

template <typename Values>
double of_rank(Values& values, std::size_t rank) {
  if (std::empty(values)) return std::numeric_limits<double>::quiet_NaN();
  const auto at = std::begin(values) + std::ptrdiff_t(rank);
  std::nth_element(std::begin(values), at, std::end(values));
  return double(*at);
}

// `share`, 0 to 1, of the others lie below: rank share * (n - 1), rounded down.
template <typename Values>
double percentile(Values& values, double share) {
  return of_rank(values, std::size_t(share * (double(std::size(values)) - 1)));
}

// Of an even number the upper of the two in the middle.
template <typename Values>
double median(Values& values) {
  return of_rank(values, std::size(values) / 2);
}

}  // namespace relievo
