// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page_controller.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo::firmware {
namespace {

TEST(DayRing, KeepsTheLastDayTheNewestAtItsEnd) {
  DayRing ring;
  ASSERT_EQ(ring.values().size(), 144U);
  EXPECT_TRUE(std::isnan(ring.values().back())) << "nothing is known yet";
  for (int i = 1; i <= 3; ++i) ring.add(i);
  EXPECT_EQ(ring.values().back(), 3);
  EXPECT_EQ(ring.values()[141], 1);
  EXPECT_TRUE(std::isnan(ring.values()[140]));
  for (int i = 4; i <= 150; ++i) ring.add(i);
  EXPECT_EQ(ring.values().front(), 7);
  EXPECT_EQ(ring.values().back(), 150);
}

}  // namespace
}  // namespace relievo::firmware
