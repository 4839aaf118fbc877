// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hal/base/groups.h"

namespace relievo {
namespace {

TEST(Statistics, AreValuesThatAreThere) {
  std::vector<int> even{9, 1, 7, 3}, odd{5, 1, 3}, one{4};
  std::vector<double> none;
  EXPECT_EQ(median(even), 7) << "the upper of the two in the middle";
  EXPECT_EQ(median(odd), 3);
  EXPECT_EQ(percentile(even, 0), 1);
  EXPECT_EQ(percentile(even, 0.5), 3) << "rounded down";
  EXPECT_EQ(percentile(even, 1), 9);
  EXPECT_EQ(percentile(one, 0.9), 4);
  EXPECT_TRUE(std::isnan(median(none)) && std::isnan(percentile(none, 0.5)));
}

TEST(Groups, HoldTheirMembersInTheOrderTheyCame) {
  Groups groups;
  EXPECT_EQ(groups.size(), 0U);
  for (int turn = 0; turn < 2; ++turn) {  // sorting again forgets the members before
    groups.sort(3, [](auto&& add) { add(2, 7), add(0, 5), add(2, 6); });
    ASSERT_EQ(groups.size(), 3U);
    EXPECT_EQ(groups.members(), 3U);
    EXPECT_EQ(std::vector(groups[0].begin(), groups[0].end()), std::vector<std::uint32_t>{5});
    EXPECT_TRUE(groups[1].empty());
    EXPECT_EQ(std::vector(groups[2].begin(), groups[2].end()), (std::vector<std::uint32_t>{7, 6}));
  }
}

}  // namespace
}  // namespace relievo
