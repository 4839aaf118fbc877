// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernel shows of screens, played by files. toolchain/vm asks a real kernel.
#include "ui/platform/sdl_display.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <string>

namespace relievo::ui {
namespace {

namespace fs = std::filesystem;

class MissingScreen : public testing::Test {
 protected:
  void SetUp() override {
    folder = testing::TempDir() + "missing-screen-XXXXXX";
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
    places = {fs::path(folder) / "dri", fs::path(folder) / "drm"};
    fs::create_directories(places.devices);
    fs::create_directories(places.monitors / "version");
  }
  void TearDown() override { fs::remove_all(folder); }

  void add_card(const std::string& name) const { std::ofstream(places.devices / name) << "card"; }
  // As for a user outside of its group: root may open everything that is there.
  void add_closed_card(const std::string& name) const {
    fs::create_symlink(places.devices / "nowhere", places.devices / name);
  }
  void add_socket(const std::string& name, const std::string& status) const {
    fs::create_directories(places.monitors / name);
    std::ofstream(places.monitors / name / "status") << status << '\n';
  }

  std::string folder;
  ScreenPlaces places;
};

TEST_F(MissingScreen, NoFolderOfDevicesIsAMissingDriver) {
  fs::remove_all(places.devices);
  const auto why = why_no_screen(places);
  ASSERT_TRUE(why.has_value());
  EXPECT_EQ(why->code, Errc::NotFound);
  EXPECT_EQ(why->where(), places.devices.string());
}

TEST_F(MissingScreen, SomethingThatOnlyDrawsForOthersIsNoScreen) {
  add_card("renderD128");
  const auto why = why_no_screen(places);
  ASSERT_TRUE(why.has_value());
  EXPECT_EQ(why->where(), places.devices.string());
}

TEST_F(MissingScreen, ACardThatMayNotBeOpenedIsNamedWithTheGroups) {
  add_closed_card("card0");
  add_socket("card0-HDMI-A-1", "connected");
  const auto why = why_no_screen(places);
  ASSERT_TRUE(why.has_value());
  EXPECT_EQ(why->code, Errc::IoFailed);
  EXPECT_EQ(why->where(), (places.devices / "card0").string());
}

TEST_F(MissingScreen, OneCardOfTwoIsEnough) {
  add_closed_card("card0");
  add_card("card1");
  add_socket("card1-DSI-1", "connected");
  EXPECT_FALSE(why_no_screen(places).has_value());
}

TEST_F(MissingScreen, NoMonitorAtAnySocketIsNamedWithTheFirst) {
  add_card("card0");
  add_socket("card0-HDMI-A-1", "disconnected");
  add_socket("card0-DP-1", "disconnected");
  fs::create_directories(places.monitors / "card0");  // the card itself has no status
  const auto why = why_no_screen(places);
  ASSERT_TRUE(why.has_value());
  EXPECT_EQ(why->code, Errc::NotFound);
  EXPECT_EQ(why->where(), (places.monitors / "card0-DP-1").string());
}

// Panels without a plug say "unknown", and a kernel that says nothing of sockets is no reason to blame one.
TEST_F(MissingScreen, AMonitorThatMayBeThereIsNotMissing) {
  add_card("card0");
  EXPECT_FALSE(why_no_screen(places).has_value());
  add_socket("card0-HDMI-A-1", "disconnected");
  add_socket("card0-DSI-1", "unknown");
  EXPECT_FALSE(why_no_screen(places).has_value());
}

}  // namespace
}  // namespace relievo::ui
