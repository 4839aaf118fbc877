// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/semi_global.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kHalfWidth = 4;
constexpr int kHalfHeight = 3;
constexpr std::uint8_t kUnknownCost = 40;   // a candidate outside the other picture: worse than any chance match (31)
constexpr std::uint16_t kFar = 0x3FFF;

// Path costs of one row of pixels; the candidates are padded by one unreachable cell on both sides.
struct PathRow {
  PathRow(std::pmr::memory_resource& memory, int width, int candidates)
      : stride(candidates + 2), cost(static_cast<std::size_t>(width * (candidates + 2)), kFar, &memory),
        least(static_cast<std::size_t>(width), 0, &memory) {}
  std::uint16_t* at(int x) { return cost.data() + static_cast<std::ptrdiff_t>(x) * stride + 1; }
  int stride;
  std::pmr::vector<std::uint16_t> cost;
  std::pmr::vector<std::uint16_t> least;
};

RELIEVO_SIMD void matching_costs(const CensusPair& pair, const std::int16_t* first, int y, int candidates,
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
    for (int k = 0; k < candidates; ++k) {
      const int other = x - pair.sign * (first[x] + k);
      const bool inside = other >= 0 && other < width && to_valid[other] != 0;
      cost[k] = inside ? static_cast<std::uint8_t>(__builtin_popcountll(from[x] ^ to[other])) : kUnknownCost;
    }
  }
}

// One step of one path: from the neighbour's costs (its first candidate differs by `shift`) to this
// pixel's, added to the sum. Returns the least.
RELIEVO_SIMD std::uint16_t path_step(const std::uint16_t* previous, std::uint16_t previous_least, int shift,
                                     const std::uint8_t* cost, int candidates, const SemiGlobalCosts& costs,
                                     std::uint16_t* path, std::uint16_t* sum) {
  const auto p1 = static_cast<std::uint16_t>(costs.step_penalty);
  const auto jump = static_cast<std::uint16_t>(previous_least + costs.jump_penalty);
  const int begin = std::clamp(-shift, 0, candidates);
  const int end = std::clamp(candidates - shift, begin, candidates);
  const auto fall = [&](int k) {
    path[k] = static_cast<std::uint16_t>(cost[k] + jump - previous_least);
  };
  for (int k = 0; k < begin; ++k) fall(k);
  const std::uint16_t* p = previous + shift;
  for (int k = begin; k < end; ++k) {
    const std::uint16_t side = std::min(p[k - 1], p[k + 1]);
    const auto step = static_cast<std::uint16_t>(side + p1);
    const std::uint16_t best = std::min(std::min(p[k], step), jump);
    path[k] = static_cast<std::uint16_t>(cost[k] + best - previous_least);
  }
  for (int k = end; k < candidates; ++k) fall(k);
  std::uint16_t least = kFar;
  for (int k = 0; k < candidates; ++k) {
    least = std::min(least, path[k]);
    sum[k] = static_cast<std::uint16_t>(sum[k] + path[k]);
  }
  return least;
}

struct Volume {
  int width, height, candidates;
  std::pmr::vector<std::uint8_t> cost;
  std::pmr::vector<std::uint16_t> sum;
  std::size_t cell(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(candidates);
  }
};

// Four paths in one sweep over the picture: along the row and from the three neighbours of the row
// before; dir = +1 top to bottom, -1 the other way round.
void sweep(Volume& volume, const Plane<std::int16_t>& first, const SemiGlobalCosts& costs, int dir,
           std::pmr::memory_resource& scratch, const std::atomic<bool>* cancelled) {
  const int w = volume.width;
  const int n = volume.candidates;
  PathRow row_path(scratch, 2, n);
  PathRow rows[3][2] = {{PathRow(scratch, w, n), PathRow(scratch, w, n)},
                        {PathRow(scratch, w, n), PathRow(scratch, w, n)},
                        {PathRow(scratch, w, n), PathRow(scratch, w, n)}};
  const int y0 = dir > 0 ? 0 : volume.height - 1;
  int now = 0;
  for (int y = y0; y >= 0 && y < volume.height; y += dir, now ^= 1) {
    if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) return;
    const std::int16_t* base = first.row(y);
    const std::int16_t* above = y == y0 ? nullptr : first.row(y - dir);
    int flip = 0;
    for (int i = 0; i < w; ++i, flip ^= 1) {
      const int x = dir > 0 ? i : w - 1 - i;
      const std::uint8_t* cost = volume.cost.data() + volume.cell(x, y);
      std::uint16_t* sum = volume.sum.data() + volume.cell(x, y);
      const auto begin_path = [&](std::uint16_t* path) {
        std::uint16_t least = kFar;
        for (int k = 0; k < n; ++k) {
          path[k] = cost[k];
          least = std::min(least, path[k]);
          sum[k] = static_cast<std::uint16_t>(sum[k] + path[k]);
        }
        return least;
      };
      row_path.least[static_cast<std::size_t>(flip)] =
          i == 0 ? begin_path(row_path.at(flip))
                 : path_step(row_path.at(flip ^ 1), row_path.least[static_cast<std::size_t>(flip ^ 1)],
                             base[x] - base[x - dir], cost, n, costs, row_path.at(flip), sum);
      for (int d = 0; d < 3; ++d) {
        const int from = x + d - 1;
        PathRow& to = rows[d][now];
        PathRow& prior = rows[d][now ^ 1];
        to.least[static_cast<std::size_t>(x)] =
            above == nullptr || from < 0 || from >= w
                ? begin_path(to.at(x))
                : path_step(prior.at(from), prior.least[static_cast<std::size_t>(from)], base[x] - above[from],
                            cost, n, costs, to.at(x), sum);
      }
    }
  }
}

float best_candidate(const std::uint16_t* sum, int candidates) {
  const int k = static_cast<int>(std::min_element(sum, sum + candidates) - sum);
  if (k == 0 || k == candidates - 1) return static_cast<float>(k);
  const float before = sum[k - 1];
  const float here = sum[k];
  const float after = sum[k + 1];
  // Equiangular fit: the census cost falls off linearly, a parabola would lock to whole pixels.
  const float slope = std::max(before, after) - here;
  return static_cast<float>(k) + (slope > 0 ? 0.5F * (before - after) / slope : 0.0F);
}

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

void semi_global(const CensusPair& pair, const Plane<std::int16_t>& first, int candidates,
                 const SemiGlobalCosts& costs, std::pmr::memory_resource& scratch, Plane<float>& disparity, const std::atomic<bool>* cancelled) {
  const int w = first.width;
  const int h = first.height;
  const std::size_t cells = static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(candidates);
  Volume volume{w, h, candidates, std::pmr::vector<std::uint8_t>(cells, 0, &scratch),
                std::pmr::vector<std::uint16_t>(cells, 0, &scratch)};
  for (int y = 0; y < h; ++y) matching_costs(pair, first.row(y), y, candidates, volume.cost.data() + volume.cell(0, y));
  sweep(volume, first, costs, +1, scratch, cancelled);
  sweep(volume, first, costs, -1, scratch, cancelled);
  if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) return;
  for (int y = 0; y < h; ++y) {
    const std::int16_t* base = first.row(y);
    const std::uint8_t* valid = pair.from_valid.row(y);
    float* to = disparity.row(y);
    for (int x = 0; x < w; ++x) {
      to[x] = kNoDisparity;
      if (valid[x] == 0) continue;
      const float d = static_cast<float>(base[x]) + best_candidate(volume.sum.data() + volume.cell(x, y), candidates);
      const float other = static_cast<float>(x) - static_cast<float>(pair.sign) * d;
      if (other >= 0 && other <= static_cast<float>(w - 1)) to[x] = d;
    }
  }
}

void cross_check(Plane<float>& left, const Plane<float>& right, float limit_px) {
  for (int y = 0; y < left.height; ++y) {
    float* l = left.row(y);
    const float* r = right.row(y);
    for (int x = 0; x < left.width; ++x) {
      if (l[x] == kNoDisparity) continue;
      const int other = static_cast<int>(std::lround(static_cast<float>(x) - l[x]));
      const bool seen = other >= 0 && other < right.width && std::abs(r[other] - l[x]) <= limit_px;
      if (!seen) l[x] = kNoDisparity;
    }
  }
}

}  // namespace relievo::pipeline
