// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/semi_global.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kHalfWidth = 4;
constexpr int kHalfHeight = 3;

constexpr std::uint16_t kFar = 0x3FFF;

// Candidates are worked on sixteen at once; the lanes past the last candidate stay unreachable.
constexpr int kLanes = 16;
int lanes_for(int candidates) { return (candidates + kLanes - 1) / kLanes * kLanes; }

// Path costs of one row of pixels. Between two pixels lie as many unreachable cells as there are lanes, so
// that a neighbour whose band begins elsewhere is read where it is, without a branch.
struct PathRow {
  PathRow(std::pmr::memory_resource& memory, int width, int lanes)
      : stride(2 * lanes),
        cost(std::size_t((width + 1) * stride), kFar, &memory),
        least(std::size_t(width), 0, &memory) {}
  std::uint16_t* at(int x) { return cost.data() + std::ptrdiff_t(x) * stride + stride / 2; }
  int stride;
  std::pmr::vector<std::uint16_t> cost;
  std::pmr::vector<std::uint16_t> least;
};

// Sixteen candidates side by side. Every cost stays below kFar, so that signed and unsigned are one.
using Lanes = std::int16_t __attribute__((vector_size(2 * kLanes)));
using Sums = std::uint16_t __attribute__((vector_size(2 * kLanes)));
#define RELIEVO_INLINE inline __attribute__((always_inline))

template <typename Vector, typename Cell>
RELIEVO_INLINE void load(const Cell* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
RELIEVO_INLINE void least_of(Lanes& a, const Lanes& b) { a = a < b ? a : b; }
// The least of all lanes, in every lane.
RELIEVO_INLINE void spread_least(Lanes& v) {
  least_of(v, __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7));
  least_of(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11));
  least_of(v, __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13));
  least_of(v, __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14));
}

// The least of the lanes of each of four, in turn: their halves side by side, then their quarters, once for
// all of them instead of once for each.
RELIEVO_INLINE void halves(const Lanes& a, const Lanes& b, Lanes& to) {
  to = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23);
  least_of(to, __builtin_shufflevector(a, b, 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30, 31));
}
RELIEVO_INLINE void least_of_each(const std::array<Lanes, 4>& v, Lanes& all) {
  Lanes ab, cd;
  halves(v[0], v[1], ab);
  halves(v[2], v[3], cd);
  // Four of the first, four of the third, four of the second, four of the last.
  all = __builtin_shufflevector(ab, cd, 0, 1, 2, 3, 16, 17, 18, 19, 8, 9, 10, 11, 24, 25, 26, 27);
  least_of(all, __builtin_shufflevector(ab, cd, 4, 5, 6, 7, 20, 21, 22, 23, 12, 13, 14, 15, 28, 29, 30, 31));
  least_of(all, __builtin_shufflevector(all, all, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13));
  least_of(all, __builtin_shufflevector(all, all, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14));
}
constexpr std::array<int, 4> kLeastAt{0, 8, 4, 12};  // where least_of_each() puts them

// One of the four paths into a pixel: the neighbour it comes from, and where its own costs go.
struct PathStep {
  const std::uint16_t* previous;  // the neighbour's costs at this pixel's first candidate
  std::uint16_t previous_least, jump;
  std::uint16_t* path;
};

// Sixteen candidates of one path, added to the total; `beyond` is kFar in the lanes that are none.
RELIEVO_INLINE void sixteen(const PathStep& step, int at, std::uint16_t step_penalty, const Lanes& cost,
                            const Lanes& beyond, Sums& total, Lanes& least) {
  const std::uint16_t* p = step.previous + at;
  Lanes best, before, after;
  load(p, best);
  load(p - 1, before);
  load(p + 1, after);
  least_of(before, after);
  before |= (best == std::int16_t(kFar)) &
            std::int16_t(kFar);  // a candidate the neighbour has not: only a jump leads there
  least_of(best, before + std::int16_t(step_penalty));
  least_of(best, Lanes{} + std::int16_t(step.jump));
  best = (cost + best - std::int16_t(step.previous_least)) | beyond;
  std::memcpy(step.path + at, &best, sizeof best);
  total += reinterpret_cast<const Sums&>(best);
  least_of(least, best);
}

struct Volume {
  // Every cell is written before it is read: nothing is cleared.
  Volume(std::pmr::memory_resource& memory, int w, int h, int many)
      : scratch(&memory), width(w), height(h), candidates(many) {}
  ~Volume() { scratch.deallocate_object(sum, cells), scratch.deallocate_object(cost, cells); }
  Volume(const Volume&) = delete;
  Volume& operator=(const Volume&) = delete;
  std::pmr::polymorphic_allocator<> scratch;
  int width, height, candidates;
  std::size_t cells{cell(0, height) + kLanes};
  std::uint8_t* cost{
      scratch.allocate_object<std::uint8_t>(cells)};  // both with room for the lanes behind the last pixel
  std::uint16_t* sum{scratch.allocate_object<std::uint16_t>(cells)};
  std::size_t cell(int x, int y) const {
    return (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(candidates);
  }
};

// Four paths in one sweep over the picture: along the row and from the three neighbours of the row
// before; dir = +1 top to bottom, -1 the other way round.
struct Sweep {
  Sweep(const CensusPair& views, Volume& cells, const Plane<std::int16_t>& band, const SemiGlobalCosts& costs,
        int direction, std::pmr::memory_resource& scratch)
      : pair(views),
        volume(cells),
        first(band),
        dir(direction),
        step_penalty(std::uint16_t(costs.step_penalty)),
        jump_penalty(std::uint16_t(costs.jump_penalty)),
        far(std::size_t(lanes + 2), kFar, &scratch),
        beyond(std::size_t(lanes), 0, &scratch),
        line(std::size_t(lanes), 0, &scratch),
        along(scratch, 2, lanes),
        rows{{{PathRow(scratch, cells.width, lanes), PathRow(scratch, cells.width, lanes)},
              {PathRow(scratch, cells.width, lanes), PathRow(scratch, cells.width, lanes)},
              {PathRow(scratch, cells.width, lanes), PathRow(scratch, cells.width, lanes)}}} {
    std::fill(beyond.begin() + cells.candidates, beyond.end(), kFar);
  }
  // A path that begins: as if from nowhere, at no cost.
  PathStep beginning(PathRow& to, int x) { return {far.data() + 1, 0, 0, to.at(x)}; }
  PathStep from(PathRow& row, int from_x, int shift, PathRow& to, int x) {
    const std::uint16_t least = row.least[std::size_t(from_x)];
    const std::uint16_t* previous = shift > -lanes && shift < lanes ? row.at(from_x) + shift : far.data() + 1;
    return {previous, least, std::uint16_t(least + jump_penalty), to.at(x)};
  }

  // The paths into pixel x, the i-th of its row: from the three of the row before, then along the row.
  // `above` is null in the first row.
  RELIEVO_INLINE std::array<PathStep, 4> into(int x, int i, int now, const std::int16_t* base,
                                              const std::int16_t* above) {
    std::array<PathStep, 4> steps{};
    for (int d = 0; d < 3; ++d) {
      auto& row = rows[std::size_t(d)];
      PathRow &target = row[std::size_t(now)], &source = row[std::size_t(now ^ 1)];
      const int at = x + d - 1;
      steps[std::size_t(d)] = above == nullptr || at < 0 || at >= volume.width
                                  ? beginning(target, x)
                                  : from(source, at, base[x] - above[at], target, x);
    }
    const int flip = i & 1;
    steps[3] = i == 0 ? beginning(along, flip) : from(along, flip ^ 1, base[x] - base[x - dir], along, flip);
    return steps;
  }

  const CensusPair& pair;
  Volume& volume;
  const Plane<std::int16_t>& first;
  int dir, lanes = lanes_for(volume.candidates);
  std::uint16_t step_penalty, jump_penalty;
  std::pmr::vector<std::uint16_t> far, beyond, line;
  PathRow along;
  std::array<std::array<PathRow, 2>, 3> rows;
};

// The least of the sums over all candidates, and the first that has it.
struct Least {
  Lanes sum = Lanes{} + std::int16_t{0x7FFF}, at{};
  RELIEVO_INLINE void hear(const Sums& total, const Lanes& beyond, int from) {
    constexpr Lanes kOrder{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const Lanes own = beyond == 0 ? reinterpret_cast<const Lanes&>(total) : Lanes{} + std::int16_t{0x7FFF};
    at = own < sum ? kOrder + std::int16_t(from) : at;
    least_of(sum, own);
  }
  RELIEVO_INLINE int candidate() const {
    Lanes least = sum;
    spread_least(least);
    Lanes first = sum == least ? at : Lanes{} + std::int16_t{0x7FFF};
    spread_least(first);
    return first[0];
  }
};

// Candidate k between its neighbours.
RELIEVO_INLINE float between(const std::uint16_t* sum, int k, int candidates) {
  if (k == 0 || k == candidates - 1) return float(k);
  const float before = sum[k - 1];
  const float here = sum[k];
  const float after = sum[k + 1];
  // Equiangular fit: the census cost falls off linearly, a parabola would lock to whole pixels.
  const float slope = std::max(before, after) - here;
  return float(k) + (slope > 0 ? 0.5F * (before - after) / slope : 0.0F);
}

// One row of a sweep. Downwards the sums are kept; a pixel's lanes reach into the next one's, which is
// written later. Upwards the second four paths are added to them, and the best candidate is known at once:
// to[x], when `to` is there.
RELIEVO_INLINE void sweep_row(Sweep& s, int y, int lanes, int now, bool begins, float* to) {
  const int w = s.volume.width, n = s.volume.candidates;
  const std::int16_t* base = s.first.row(y);
  const std::int16_t* above = begins ? nullptr : s.first.row(y - s.dir);
  const std::uint8_t* valid = s.pair.from_valid.row(y);
  for (int i = 0; i < w; ++i) {
    const int x = s.dir > 0 ? i : w - 1 - i, flip = i & 1;
    const std::array<PathStep, 4> steps = s.into(x, i, now, base, above);
    const std::uint8_t* cost = s.volume.cost + s.volume.cell(x, y);
    std::uint16_t* sum = s.volume.sum + s.volume.cell(x, y);
    const Lanes far = Lanes{} + std::int16_t(kFar);
    std::array<Lanes, 4> least{far, far, far, far};
    Least best;
    for (int b = 0; b < lanes; b += kLanes) {
      Sums total{}, other{};
      Lanes beyond;
      load(s.beyond.data() + b, beyond);
      std::uint8_t __attribute__((vector_size(kLanes))) bits;
      load(cost + b, bits);
      const Lanes own = __builtin_convertvector(bits, Lanes);
      for (std::size_t d = 0; d < 4; ++d) sixteen(steps[d], b, s.step_penalty, own, beyond, total, least[d]);
      if (to != nullptr) {
        load(sum + b, other);
        total += other;
        best.hear(total, beyond, b);
      }
      std::memcpy(to == nullptr ? sum + b : s.line.data() + b, &total, sizeof total);
    }
    Lanes each;
    least_of_each(least, each);
    s.along.least[std::size_t(flip)] = std::uint16_t(each[kLeastAt[3]]);
    for (std::size_t d = 0; d < 3; ++d)
      s.rows[d][std::size_t(now)].least[std::size_t(x)] = std::uint16_t(each[kLeastAt[d]]);
    if (to == nullptr) continue;
    to[x] = kNoDisparity;
    if (valid[x] == 0) continue;
    const float d = float(base[x]) + between(s.line.data(), best.candidate(), n);
    const float other = float(x) - float(s.pair.sign) * d;
    if (other >= 0 && other <= float(w - 1)) to[x] = d;
  }
}

// The common band fits into one set of lanes: then the compiler knows it.
RELIEVO_SIMD void sweep_row_of_sixteen(Sweep& s, int y, int now, bool begins, float* to) {
  sweep_row(s, y, kLanes, now, begins, to);
}
RELIEVO_SIMD void sweep_row_of_any(Sweep& s, int y, int now, bool begins, float* to) {
  sweep_row(s, y, s.lanes, now, begins, to);
}

// Down: `disparity` null. False once cancelled.
bool sweep(Sweep&& s, Plane<float>* disparity, const std::atomic<bool>* cancelled) {
  const int h = s.volume.height, y0 = s.dir > 0 ? 0 : h - 1;
  int now = 0;
  for (int y = y0; y >= 0 && y < h; y += s.dir, now ^= 1) {
    if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) return false;
    float* to = disparity == nullptr ? nullptr : disparity->row(y);
    (s.lanes == kLanes ? sweep_row_of_sixteen : sweep_row_of_any)(s, y, now, y == y0, to);
  }
  return true;
}

}  // namespace

RELIEVO_SIMD void census_row(const Plane<float>& grey, Plane<std::uint64_t>& census, int y) {
  const int w = grey.width;
  std::uint64_t* to = census.row(y);
  std::fill(to, to + w, 0);
  if (y < kHalfHeight || y >= grey.height - kHalfHeight) return;
  const float* centre = grey.row(y);
  for (int j = -kHalfHeight; j <= kHalfHeight; ++j)
    for (int i = -kHalfWidth; i <= kHalfWidth; ++i) {
      if (i == 0 && j == 0) continue;
      const float* other = grey.row(y + j) + i;
      for (int x = kHalfWidth; x < w - kHalfWidth; ++x)
        to[x] = (to[x] << 1) | std::uint64_t(other[x] < centre[x]);
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
      std::memset(cost, kUnknownCost, std::size_t(candidates));
      continue;
    }
    const int nearest = x - pair.sign * first[x], last = nearest - pair.sign * (candidates - 1);
    if (std::min(nearest, last) >= 0 && std::max(nearest, last) < width) {
      for (int k = 0; k < candidates; ++k) {
        const int other = nearest - pair.sign * k;
        const auto bits = std::uint8_t(__builtin_popcountll(from[x] ^ to[other]));
        cost[k] = to_valid[other] != 0 ? bits : kUnknownCost;
      }
      continue;
    }
    for (int k = 0; k < candidates; ++k) {
      const int other = nearest - pair.sign * k;
      const bool inside = other >= 0 && other < width && to_valid[other] != 0;
      cost[k] = inside ? std::uint8_t(__builtin_popcountll(from[x] ^ to[other])) : kUnknownCost;
    }
  }
}

void semi_global(const CensusPair& pair, const Plane<std::int16_t>& first, int candidates,
                 const SemiGlobalCosts& costs, std::pmr::memory_resource& scratch, Plane<float>& disparity,
                 const std::atomic<bool>* cancelled) {
  const int h = first.height;
  Volume volume(scratch, first.width, h, candidates);
  std::memset(volume.cost + volume.cells - kLanes, 0, kLanes);
  for (int y = 0; y < h; ++y)
    census_costs(pair, first.row(y), y, candidates, volume.cost + volume.cell(0, y));
  if (sweep(Sweep(pair, volume, first, costs, +1, scratch), nullptr, cancelled))
    sweep(Sweep(pair, volume, first, costs, -1, scratch), &disparity, cancelled);
}

}  // namespace relievo::pipeline
