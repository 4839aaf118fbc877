// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/semi_global.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <bit>
#include <cstdlib>
#include <memory_resource>
#include <random>
#include <vector>

namespace relievo::pipeline {
namespace {

constexpr int kCostsWidth = 37, kCostsHeight = 21;
constexpr int kUnknown = 40;

struct Views {
  explicit Views(int spread) {
    std::mt19937 random(7);
    for (auto* census : {&left, &right})
      for (auto& bits : census->values) bits = (std::uint64_t{random()} << 32 | random()) >> 2;
    for (auto* valid : {&left_valid, &right_valid})
      for (auto& v : valid->values) v = random() % 10 != 0 ? 1 : 0;
    for (auto& f : first.values)
      f = static_cast<std::int16_t>(static_cast<int>(random() % static_cast<unsigned>(2 * spread + 1)) -
                                    spread);
  }
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  Plane<std::uint64_t> left{memory, kCostsWidth, kCostsHeight}, right{memory, kCostsWidth, kCostsHeight};
  Plane<std::uint8_t> left_valid{memory, kCostsWidth, kCostsHeight},
      right_valid{memory, kCostsWidth, kCostsHeight};
  Plane<std::int16_t> first{memory, kCostsWidth, kCostsHeight};
};

// The recurrence as Hirschmueller writes it, path by path and candidate by candidate, over disparities
// instead of lanes.
struct PathTwin {
  const Views& v;
  int sign, candidates;
  SemiGlobalCosts costs;
  using Cells = std::vector<std::vector<int>>;

  int first(int x, int y) const { return v.first.row(y)[x]; }
  int cost(int x, int y, int k) const {
    const int other = x - sign * (first(x, y) + k);
    const bool seen =
        v.left_valid.row(y)[x] != 0 && other >= 0 && other < kCostsWidth && v.right_valid.row(y)[other] != 0;
    return seen ? std::popcount(v.left.row(y)[x] ^ v.right.row(y)[other]) : kUnknown;
  }
  void add_path(int dx, int dy, Cells& sums) const {
    Cells path(kCostsWidth * kCostsHeight);
    for (int i = 0; i < kCostsWidth * kCostsHeight; ++i) {
      const int x = dx >= 0 ? i % kCostsWidth : kCostsWidth - 1 - i % kCostsWidth,
                y = dy >= 0 ? i / kCostsWidth : kCostsHeight - 1 - i / kCostsWidth;
      const int px = x - dx, py = y - dy;
      const bool begins = px < 0 || px >= kCostsWidth || py < 0 || py >= kCostsHeight;
      auto& own = path[static_cast<std::size_t>(y * kCostsWidth + x)];
      for (int k = 0; k < candidates; ++k) {
        own.push_back(cost(x, y, k));
        if (begins) continue;
        const auto& before = path[static_cast<std::size_t>(py * kCostsWidth + px)];
        const int least = *std::min_element(before.begin(), before.end()),
                  at = first(x, y) + k - first(px, py);
        int best = least + costs.jump_penalty;
        if (at >= 0 && at < candidates) {
          best = std::min(best, before[static_cast<std::size_t>(at)]);
          if (at > 0) best = std::min(best, before[static_cast<std::size_t>(at - 1)] + costs.step_penalty);
          if (at + 1 < candidates)
            best = std::min(best, before[static_cast<std::size_t>(at + 1)] + costs.step_penalty);
        }
        own.back() += best - least;
      }
      for (int k = 0; k < candidates; ++k)
        sums[static_cast<std::size_t>(y * kCostsWidth + x)][static_cast<std::size_t>(k)] +=
            own[static_cast<std::size_t>(k)];
    }
  }
  Cells sums() const {
    Cells all(kCostsWidth * kCostsHeight, std::vector<int>(static_cast<std::size_t>(candidates), 0));
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (dx != 0 || dy != 0) add_path(dx, dy, all);
    return all;
  }
};

// Bands that fit into one set of lanes, that fill it, that need more, and neighbours whose bands hardly meet.
TEST(SemiGlobal, FindsWhatItsSlowTwinFinds) {
  for (const int candidates : {12, 16, 17, 40})
    for (const int spread : {0, 2, 20})
      for (const int sign : {1, -1}) {
        const Views v(spread);
        Plane<float> found(v.memory, kCostsWidth, kCostsHeight, 0);
        semi_global({v.left, v.right, v.left_valid, v.right_valid, sign}, v.first, candidates, {}, *v.memory,
                    found);
        const PathTwin twin{v, sign, candidates, {}};
        const auto sums = twin.sums();
        int known = 0;
        for (int y = 0; y < kCostsHeight; ++y)
          for (int x = 0; x < kCostsWidth; ++x) {
            const auto& sum = sums[static_cast<std::size_t>(y * kCostsWidth + x)];
            const auto k = std::min_element(sum.begin(), sum.end()) - sum.begin();
            const float d = found.row(y)[x];
            if (v.left_valid.row(y)[x] == 0) {
              EXPECT_EQ(d, kNoDisparity);
            } else if (d != kNoDisparity) {
              ++known;
              EXPECT_LE(std::abs(d - static_cast<float>(v.first.row(y)[x] + k)), 0.5F)
                  << candidates << ' ' << spread << ' ' << x << ' ' << y;
            }
          }
        EXPECT_GT(known, kCostsWidth * kCostsHeight / 3);
      }
}

}  // namespace
}  // namespace relievo::pipeline
