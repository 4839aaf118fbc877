// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/coarse/semi_global.h"

#include <gtest/gtest.h>

#include <bit>
#include <memory_resource>
#include <random>
#include <vector>

namespace relievo::pipeline {
namespace {

constexpr int kCensusWidth = 23, kCensusHeight = 17, kAcross = 4, kUp = 3;

Plane<float> picture(float gain, float offset) {
  Plane<float> grey(std::pmr::get_default_resource(), kCensusWidth, kCensusHeight);
  std::mt19937 random(11);
  for (float& v : grey.values) v = gain * static_cast<float>(random() % 64) + offset;
  return grey;
}

Plane<std::uint64_t> census_of(const Plane<float>& grey) {
  Plane<std::uint64_t> census(std::pmr::get_default_resource(), kCensusWidth, kCensusHeight, 99);
  for (int y = 0; y < kCensusHeight; ++y) census_row(grey, census, y);
  return census;
}

TEST(Census, HasABitForEveryDarkerNeighbourAndNoneAtTheBorder) {
  const Plane<float> grey = picture(1, 0);
  const Plane<std::uint64_t> census = census_of(grey);
  for (int y = 0; y < kCensusHeight; ++y)
    for (int x = 0; x < kCensusWidth; ++x) {
      int darker = 0;
      const bool whole = x >= kAcross && x < kCensusWidth - kAcross && y >= kUp && y < kCensusHeight - kUp;
      for (int j = -kUp; whole && j <= kUp; ++j)
        for (int i = -kAcross; i <= kAcross; ++i) darker += grey.row(y + j)[x + i] < grey.row(y)[x] ? 1 : 0;
      EXPECT_EQ(std::popcount(census.row(y)[x]), darker) << x << ' ' << y;
    }
}

TEST(Census, IsBlindToGainAndOffset) {
  EXPECT_EQ(census_of(picture(1, 0)).values, census_of(picture(0.5F, 40)).values);
}

// Both views alike but for three pixels of disparity: nothing is cheaper than the truth, and what nobody sees
// costs most.
TEST(Census, CostsNothingAtTheTruth) {
  constexpr int kShift = 3, kCandidates = 6;
  const Plane<std::uint64_t> left = census_of(picture(1, 0));
  Plane<std::uint64_t> right(std::pmr::get_default_resource(), kCensusWidth, kCensusHeight);
  for (int y = 0; y < kCensusHeight; ++y)
    for (int x = kShift; x < kCensusWidth; ++x) right.row(y)[x - kShift] = left.row(y)[x];
  const Plane<std::uint8_t> seen(std::pmr::get_default_resource(), kCensusWidth, kCensusHeight, 1);
  Plane<std::uint8_t> blind = seen;
  blind.row(8)[12] = 0;
  const std::vector<std::int16_t> first(kCensusWidth, 1);
  std::vector<std::uint8_t> cost(std::size_t{kCensusWidth} * kCandidates);
  census_costs({left, right, seen, blind, +1}, first.data(), 8, kCandidates, cost.data());
  const auto at = [&](int x, int disparity) {
    return cost[static_cast<std::size_t>(x * kCandidates + disparity - 1)];
  };
  for (int x = kShift; x < kCensusWidth; ++x)
    EXPECT_EQ(at(x, kShift), x - kShift == 12 ? kUnknownCost : 0) << x;
  EXPECT_GT(at(10, 2), 0);
  EXPECT_EQ(at(2, 4), kUnknownCost) << "left of the picture";
  census_costs({right, left, seen, seen, -1}, first.data(), 8, kCandidates, cost.data());
  for (int x = 0; x < kCensusWidth - kShift; ++x) EXPECT_EQ(at(x, kShift), 0) << "from the right view, " << x;
}

}  // namespace
}  // namespace relievo::pipeline
