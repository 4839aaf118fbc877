// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipeline/mesh/lattice/cell_mask.h"

namespace relievo::pipeline {
namespace {

constexpr int kColumns = 37, kRows = 29;
constexpr float kWidth = 0.7F, kHeight = 0.4F;  // cells need not be square

struct Room {
  std::pmr::monotonic_buffer_resource memory;
  MaskShaper shaper{kColumns, kRows, kWidth, kHeight, &memory};
  CellMask mask{std::size_t{kColumns} * kRows, 0, &memory};
  std::uint8_t& at(int c, int r) {
    return mask[static_cast<std::size_t>(r) * kColumns + static_cast<std::size_t>(c)];
  }
  void fill(int left, int top, int right, int bottom) {
    for (int r = top; r <= bottom; ++r)
      for (int c = left; c <= right; ++c) at(c, r) = 1;
  }
  long count() const { return std::count(mask.begin(), mask.end(), 1); }
};

void scatter(Room& room, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution in(share);
  for (std::uint8_t& cell : room.mask) cell = in(random);
}

// The slow and obvious way: every cell against every other.
bool any_within(Room& room, int c, int r, std::uint8_t wanted, float radius) {
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x)
      if (room.at(x, y) == wanted &&
          std::hypot(static_cast<float>(x - c) * kWidth, static_cast<float>(y - r) * kHeight) <= radius)
        return true;
  return false;
}

TEST(MaskShaper, ADiscIsRoundInMillimetres) {
  Room room;
  scatter(room, 0.01, 5);
  Room before;
  before.mask = room.mask;
  room.shaper.dilate(room.mask, 2.05F);
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c)
      EXPECT_EQ(room.at(c, r), any_within(before, c, r, 1, 2.05F)) << c << ' ' << r;
}

TEST(MaskShaper, ErodingTakesTheBorderForTheOutside) {
  Room room;
  room.fill(0, 0, kColumns - 1, kRows - 1);
  room.at(20, 15) = 0;
  Room before;
  before.mask = room.mask;
  room.shaper.erode(room.mask, 1.45F);
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c) {
      const float to_border =
          std::min({static_cast<float>(c + 1) * kWidth, static_cast<float>(kColumns - c) * kWidth,
                    static_cast<float>(r + 1) * kHeight, static_cast<float>(kRows - r) * kHeight});
      EXPECT_EQ(room.at(c, r), to_border > 1.45F && !any_within(before, c, r, 0, 1.45F)) << c << ' ' << r;
    }
}

TEST(MaskShaper, OpeningCutsAStripOffAndKeepsTheRest) {
  Room room;
  room.fill(3, 3, 20, 25);
  room.fill(21, 12, 34, 14);  // 1.2 mm wide
  room.shaper.open(room.mask, 2);
  EXPECT_EQ(room.at(30, 13), 0);
  EXPECT_EQ(room.at(12, 14), 1);
  EXPECT_EQ(room.at(4, 14), 1);
  Room again;
  again.mask = room.mask;
  again.shaper.open(again.mask, 2);
  EXPECT_EQ(again.mask, room.mask) << "an opening opens once";
}

TEST(MaskShaper, ClosingBridgesWhatIsNarrowAndTakesNothingOut) {
  Room room;
  room.fill(3, 3, 15, 25);
  room.fill(18, 3, 34, 25);  // a crack of two cells between
  Room before;
  before.mask = room.mask;
  room.shaper.close(room.mask, 1.5F, 1.5F);
  EXPECT_EQ(room.at(16, 14), 1);
  for (std::size_t k = 0; k < room.mask.size(); ++k) EXPECT_GE(room.mask[k], before.mask[k]);
}

TEST(MaskShaper, AHoleIsWhatTheBorderCannotReach) {
  Room room;
  room.fill(5, 5, 25, 20);
  room.at(10, 10) = room.at(11, 11) = 0;              // a hole, joined by a corner
  for (int c = 15; c <= 25; ++c) room.at(c, 12) = 0;  // a fjord
  room.shaper.fill_holes(room.mask);
  EXPECT_EQ(room.at(10, 10), 1);
  EXPECT_EQ(room.at(11, 11), 1);
  EXPECT_EQ(room.at(20, 12), 0);
  EXPECT_EQ(room.at(2, 2), 0);
}

TEST(MaskShaper, PiecesAreJoinedThroughSides) {
  Room room;
  room.fill(2, 2, 6, 6);    // 25
  room.fill(7, 7, 8, 8);    // 4, touching by a corner
  room.fill(20, 2, 22, 4);  // 9
  Room other;
  other.mask = room.mask;
  room.shaper.drop_pieces_below(room.mask, 5);
  EXPECT_EQ(room.count(), 34);
  other.shaper.keep_largest_piece(other.mask);
  EXPECT_EQ(other.count(), 25);
  EXPECT_EQ(other.at(4, 4), 1);
}

// Against the Gaussian itself, summed over all cells.
TEST(MaskShaper, StraightensByWhatLiesAround) {
  constexpr float kSigma = 1.5F;
  Room room;
  scatter(room, 0.2, 5);
  room.fill(6, 5, 30, 14);
  room.fill(12, 15, 15, 24);
  const CellMask before(room.mask, &room.memory);
  room.shaper.straighten(room.mask, kSigma, 0.4F);
  int doubtful = 0;
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c) {
      double sum = 0;
      for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x) {
          const double dx = (x - c) * static_cast<double>(kWidth) / static_cast<double>(kSigma);
          const double dy = (y - r) * static_cast<double>(kHeight) / static_cast<double>(kSigma);
          if (before[static_cast<std::size_t>(y) * kColumns + static_cast<std::size_t>(x)])
            sum += std::exp(-(dx * dx + dy * dy) / 2);
        }
      const double share = sum * 0.7F * 0.4F / (2 * 3.14159265 * 1.5 * 1.5);
      if (std::abs(share - 0.4) < 0.04) ++doubtful;  // three boxes are no Gaussian, but nearly
      else EXPECT_EQ(room.at(c, r) != 0, share > 0.4) << c << ' ' << r << ' ' << share;
    }
  EXPECT_LT(doubtful, 200);
  EXPECT_GT(room.count(), 100);
}

}  // namespace
}  // namespace relievo::pipeline
