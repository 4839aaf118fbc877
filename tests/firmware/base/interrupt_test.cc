// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/console.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace relievo::firmware {
namespace {

// A process of its own: the handlers are installed once.
[[noreturn]] void hang_up(bool under_nohup) {
  std::signal(SIGHUP, under_nohup ? SIG_IGN : SIG_DFL);
  const auto& stop = interrupted();
  std::raise(SIGHUP);
  std::_Exit(stop ? 1 : 0);
}

TEST(InterruptDeathTest, AHangUpEndsWhatWasNotStartedToOutliveIt) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(hang_up(false), testing::ExitedWithCode(1), "");
  EXPECT_EXIT(hang_up(true), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace relievo::firmware
