// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which holes of the rough surface are bridged: those that it encloses, and no others.
#include "pipeline/match/coarse/semi_global.h"

#include <gtest/gtest.h>

#include <memory_resource>
#include <string>
#include <vector>

namespace relievo::pipeline {
namespace {

// '#': the surface, a plane in disparity; '.': nothing, but a hole may lie there; ' ': not even that.
std::vector<std::string> bridged(const std::vector<std::string>& rows, int largest) {
  std::pmr::memory_resource& memory = *std::pmr::get_default_resource();
  const int w = int(rows.front().size()), h = int(rows.size());
  const auto plane = [](int x, int y) { return 10 + 0.5F * float(x) - 0.25F * float(y); };
  Plane<std::uint8_t> usable(&memory, w, h), domain(&memory, w, h);
  Plane<float> disparity(&memory, w, h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const char at = rows[std::size_t(y)][std::size_t(x)];
      usable.row(y)[x] = at == ' ' ? 0 : 1;
      domain.row(y)[x] = at == '#' ? 1 : 0;
      disparity.row(y)[x] = at == '#' ? plane(x, y) : -1000;
    }
  bridge_holes(usable, largest, domain, disparity, memory);
  std::vector<std::string> seen = rows;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      if (domain.row(y)[x] == 0) continue;
      seen[std::size_t(y)][std::size_t(x)] = '#';
      EXPECT_NEAR(disparity.row(y)[x], plane(x, y), 1e-3F) << x << ' ' << y;
    }
  return seen;
}

TEST(CoarseSurface, AnEnclosedHoleIsBridgedAlongThePlaneOfItsRim) {
  EXPECT_EQ(bridged({"########", "##...###", "##.#..##", "########"}, 6),
            (std::vector<std::string>{"########", "########", "########", "########"}));
  EXPECT_EQ(bridged({"########", "##...###", "##.#..##", "########"}, 5),
            (std::vector<std::string>{"########", "##...###", "##.#..##", "########"}))
      << "too large";
}

// Both open holes touch the same place where nothing may lie, the third touches none.
TEST(CoarseSurface, TwoHolesThatOpenToTheSamePlaceAreBothOpen) {
  EXPECT_EQ(bridged({"########", "#.. ..##", "########", "#.######", "########"}, 5),
            (std::vector<std::string>{"########", "#.. ..##", "########", "########", "########"}));
}

TEST(CoarseSurface, AHoleAtThePicturesRimIsOpen) {
  for (const std::vector<std::string>& open : {std::vector<std::string>{"##.##", "#...#", "#####"},
                                               {"#####", "## ##", "#...#", "#####"},
                                               {"#####", "....#", "#####"}})
    EXPECT_EQ(bridged(open, 5), open);
  EXPECT_EQ(bridged({"##.##", "#.#.#", "#.#.#", "#####"}, 5),
            (std::vector<std::string>{"##.##", "#####", "#####", "#####"}));
  EXPECT_EQ(bridged({"#####", "#.#.#", ".#.##", "##.##", "##.##"}, 5),
            (std::vector<std::string>{"#####", "#####", ".#.##", "##.##", "##.##"}));
}

}  // namespace
}  // namespace relievo::pipeline
