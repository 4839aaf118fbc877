// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/census.h"

#include <algorithm>
#include <cstring>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kHalfWidth = 4;
constexpr int kHalfHeight = 3;

}  // namespace

RELIEVO_SIMD void census_rows(const Plane<float>& grey, Plane<std::uint64_t>& census, int begin, int end) {
  const int w = grey.width;
  for (int y = begin; y < end; ++y) {
    std::uint64_t* to = census.row(y);
    std::fill(to, to + w, 0);
    if (y < kHalfHeight || y >= grey.height - kHalfHeight) continue;
    const float* centre = grey.row(y);
    for (int j = -kHalfHeight; j <= kHalfHeight; ++j)
      for (int i = -kHalfWidth; i <= kHalfWidth; ++i) {
        if (i == 0 && j == 0) continue;
        const float* other = grey.row(y + j) + i;
        for (int x = kHalfWidth; x < w - kHalfWidth; ++x)
          to[x] = (to[x] << 1) | static_cast<std::uint64_t>(other[x] < centre[x]);
      }
  }
}

RELIEVO_SIMD void census_costs(const CensusPair& pair, const std::int16_t* first, int y, int candidates,
                               std::uint8_t* cost) {
  const std::uint64_t* from = pair.from.row(y);
  const std::uint64_t* to = pair.to.row(y);
  const std::uint8_t* from_valid = pair.from_valid.row(y);
  const std::uint8_t* to_valid = pair.to_valid.row(y);
  const int width = pair.from.width;
  for (int x = 0; x < width; ++x, cost += candidates) {
    if (from_valid[x] == 0) {
      std::memset(cost, kUnknownCost, static_cast<std::size_t>(candidates));
      continue;
    }
    const int nearest = x - pair.sign * first[x], last = nearest - pair.sign * (candidates - 1);
    if (std::min(nearest, last) >= 0 && std::max(nearest, last) < width) {
      for (int k = 0; k < candidates; ++k) {
        const int other = nearest - pair.sign * k;
        const auto bits = static_cast<std::uint8_t>(__builtin_popcountll(from[x] ^ to[other]));
        cost[k] = to_valid[other] != 0 ? bits : kUnknownCost;
      }
      continue;
    }
    for (int k = 0; k < candidates; ++k) {
      const int other = nearest - pair.sign * k;
      const bool inside = other >= 0 && other < width && to_valid[other] != 0;
      cost[k] = inside ? static_cast<std::uint8_t>(__builtin_popcountll(from[x] ^ to[other])) : kUnknownCost;
    }
  }
}

}  // namespace relievo::pipeline
