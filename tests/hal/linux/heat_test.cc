// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/device.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace relievo::hal {
namespace {

struct Thermal {
  test::TemporaryFolder folder;
  void say(const std::string& zone, const std::string& file, const std::string& words) const {
    std::filesystem::create_directories(folder.path() / zone);
    std::ofstream(folder.path() / zone / file) << words << '\n';
  }
};

TEST(Heat, IsNearWhereAZoneIsNearItsCriticalPointAndNowhereElse) {
  const Thermal t;
  EXPECT_FALSE(near_switching_off(t.folder.path() / "nothing")) << "a machine without sensors";
  t.say("thermal_zone0", "temp", "99000");
  EXPECT_FALSE(near_switching_off(t.folder.path())) << "it says no critical point";
  t.say("thermal_zone0", "trip_point_0_type", "passive");
  t.say("thermal_zone0", "trip_point_0_temp", "90000");
  EXPECT_FALSE(near_switching_off(t.folder.path())) << "it slows down, it does not switch off";
  t.say("thermal_zone0", "trip_point_1_type", "critical");
  t.say("thermal_zone0", "trip_point_1_temp", "105000");
  EXPECT_FALSE(near_switching_off(t.folder.path()));
  t.say("thermal_zone0", "temp", "100000");
  EXPECT_TRUE(near_switching_off(t.folder.path()));
  t.say("thermal_zone0", "temp", "40000");
  t.say("thermal_zone1", "temp", "47000");
  t.say("thermal_zone1", "trip_point_0_type", "critical");
  t.say("thermal_zone1", "trip_point_0_temp", "-274000");
  EXPECT_FALSE(near_switching_off(t.folder.path())) << "a critical point that is none";
  t.say("thermal_zone1", "trip_point_0_temp", "50000");
  EXPECT_TRUE(near_switching_off(t.folder.path())) << "the second zone counts, too";
  t.say("thermal_zone1", "temp", "no number");
  EXPECT_FALSE(near_switching_off(t.folder.path()));
}

}  // namespace
}  // namespace relievo::hal
