// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Erasing by age goes by a clock that may be wrong for a while.
#include <gtest/gtest.h>

#include <atomic>

#include "firmware/service/device_settings.h"
#include "tests/storage/sample.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

using std::chrono::days;

TEST(Retention, AClockThatWasSetBackForAWhileHasNotJumpedWhenItIsRightAgain) {
  const test::TemporaryFolder folder;
  const auto store = storage::test::opened(folder.path(), storage::test::kNoReserve);
  const storage::test::StillClock clock;
  EventLog log(clock, {});
  const std::atomic<bool> stop{false};
  pipeline::Progress progress;
  JobControl control{stop, progress};
  int erased = 0;
  const auto now = std::chrono::floor<std::chrono::milliseconds>(clock.wall_now());
  const auto at = [&](storage::WallTime time) {
    return erase_expired(*store, time, 365, log, control, erased);
  };
  ASSERT_TRUE(trust_clock(*store, now));
  EXPECT_TRUE(at(now - days(20'000)));
  EXPECT_TRUE(at(now + days(1)));
  EXPECT_TRUE(at(now + days(61))) << "what is seen goes on with the days";
  EXPECT_EQ(storage::test::code_of(at(now + days(200))), Errc::InvalidState);
  EXPECT_EQ(erased, 0);
}

}  // namespace
}  // namespace relievo::firmware
