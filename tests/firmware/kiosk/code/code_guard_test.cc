// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/stored_visits.h"

#include <gtest/gtest.h>

#include "storage/sqlite/sqlite_store.h"
#include "tests/support/played_device.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

class CodeGuardTest : public testing::Test {
 protected:
  // As after a start of the program.
  bool may() {
    const auto store = storage::open_sqlite_store(folder.path(), clock, {});
    EXPECT_TRUE(store.has_value());
    const auto said = CodeGuard(**store, clock).spend();
    EXPECT_TRUE(said.has_value());
    return said && *said;
  }
  int tries() {
    int count = 0;
    while (count < 100 && may()) ++count;
    return count;
  }
  test::PlayedWorld world;
  test::PlayedClock clock{world};
  test::TemporaryFolder folder;
};

TEST_F(CodeGuardTest, TenAnHourHoweverOftenItIsStarted) {
  EXPECT_EQ(tries(), kMostWrongCodes);
  world.wall_shift_s = 3500;
  EXPECT_FALSE(may());
  world.wall_shift_s = 3700;
  EXPECT_EQ(tries(), kMostWrongCodes);
  world.wall_shift_s = -86'400;  // the clock is set back: the hour begins anew, no try is won
  EXPECT_FALSE(may());
  world.wall_shift_s = -86'400 + 3500;
  EXPECT_FALSE(may());
  world.wall_shift_s = -86'400 + 3700;
  EXPECT_TRUE(may());
}

TEST_F(CodeGuardTest, ARightOneDoesNotCountAndASettingThatIsSpoiltBars) {
  const auto store = storage::open_sqlite_store(folder.path(), clock, {});
  ASSERT_TRUE(store.has_value());
  CodeGuard guard(**store, clock);
  for (int i = 0; i < 3 * kMostWrongCodes; ++i) {
    EXPECT_TRUE(*guard.spend());
    ASSERT_TRUE(guard.was_right().has_value());
  }
  ASSERT_TRUE((*store)->set_setting(kCodesSetting, "what is this").has_value());
  EXPECT_FALSE(*guard.spend());
  world.wall_shift_s = 3700;
  EXPECT_TRUE(*guard.spend());
}

}  // namespace
}  // namespace relievo::firmware
