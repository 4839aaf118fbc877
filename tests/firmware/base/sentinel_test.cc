// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/sentinel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>

#include "firmware/base/budget.h"
#include "tests/support/manual_clock.h"

namespace relievo::firmware {
namespace {

TEST(Sentinel, TellsOfAHangOnceAndOfNoneWhileItIsKicked) {
  hal::ManualClock time;
  std::atomic<int> hangs{0};
  Sentinel sentinel(time, [&hangs] { ++hangs; });
  const auto looks_thrice = [] { std::this_thread::sleep_for(4 * budget::kTick); };
  time.advance(budget::kHangLimit);
  sentinel.kick();
  time.advance(budget::kHangLimit - std::chrono::milliseconds(1));
  looks_thrice();
  EXPECT_EQ(hangs, 0);
  time.advance(std::chrono::milliseconds(1));
  while (hangs == 0) looks_thrice();
  looks_thrice();
  EXPECT_EQ(hangs, 1) << "once";
  sentinel.kick();
  time.advance(budget::kHangLimit);
  while (hangs == 1) looks_thrice();
  EXPECT_EQ(hangs, 2) << "the next hang is another";
}

TEST(SentinelDeathTest, EndsTheProgramAndSaysWhy) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(Sentinel::end_program(), testing::KilledBySignal(SIGABRT), "the program hangs");
}

}  // namespace
}  // namespace relievo::firmware
