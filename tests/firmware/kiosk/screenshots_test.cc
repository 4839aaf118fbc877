// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The enrolment behind the pictures of all pages, on the simulated rig: what a person would pass by does not
// end it, what nobody can pass by is told in its own words. Mostly without GL: what is written is the head of
// the page that invites.
#include "firmware/demo/gallery.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "firmware/base/console.h"
#include "hal/clock.h"
#include "hal/sim/device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/support/played_device.h"
#include "tests/support/small_device.h"
#include "tests/support/temporary_folder.h"
#include "tests/ui/quiet_driver.h"
#include "ui/platform/sdl_display.h"

namespace relievo::firmware {
namespace {

const hal::sim::RigOptions kScreensRig = test::small_rig(0.5);

class ScreenshotsTest : public testing::Test {
 protected:
  ScreenshotsTest() {
    EXPECT_TRUE(ui::prepare_languages().has_value());
    args.store = folder.path() / "store";
    args.screenshots = folder.path() / "pictures";
    args.write_invitation_head = true;
    std::filesystem::create_directories(args.store);
    std::filesystem::create_directories(args.screenshots);
    services.open_device = [](std::string_view) {
      hal::SimDeviceOptions options;
      options.simulation.rig = kScreensRig;
      options.album = test::album_folder();
      return hal::make_sim_device(options);
    };
    services.open_store = [this](const Path& at, bool) { return storage::open_sqlite_store(at, clock, {}); };
    services.simulated_calibration = [this]() -> Result<pipeline::StereoCalibration> {
      RELIEVO_TRY(hal::sim::write_rig(folder.path() / "rig.yml", hal::sim::make_rig(kScreensRig)));
      return pipeline::read_calibration(folder.path() / "rig.yml");
    };
  }
  Result<void> take() {
    RELIEVO_TRY_ASSIGN(const auto kiosk, Kiosk::open(args, services));
    return take_screenshots(args, *kiosk, console);
  }

  test::TemporaryFolder folder;
  hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  KioskArgs args;
};

TEST_F(ScreenshotsTest, ARunThatEndedInTheMiddleDoesNotEndTheNextOne) {
  std::ofstream(args.store / "relievo.running").put('\n');  // as of one that was killed
  const Result<void> taken = take();
  ASSERT_TRUE(taken.has_value()) << taken.error().what.view();
  EXPECT_GT(std::filesystem::file_size(args.screenshots / "invitation_head.face"), 10'000U);
}

TEST_F(ScreenshotsTest, AClockThatIsWrongIsToldAsSuch) {
  test::PlayedWorld world;
  world.wall_shift_s = -40LL * 365 * 86'400;
  services.open_device = [&world](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
    return std::unique_ptr<hal::Device>(
        std::make_unique<test::PlayedDevice>(world, kScreensRig.width_px, kScreensRig.height_px));
  };
  const Result<void> taken = take();
  ASSERT_FALSE(taken.has_value());
  EXPECT_NE(taken.error().what.view().find("clock"), std::string_view::npos) << taken.error().what.view();
}

TEST_F(ScreenshotsTest, AStopEndsThemBetweenTwoPages) {
  setenv("SDL_VIDEODRIVER", "offscreen", 1);
  const ui::QuietDriver quiet;
  const auto display = ui::open_sdl_display({64, 64});
  ASSERT_TRUE(display.has_value()) << display.error().where();
  args.write_invitation_head = false;
  args.only = "1280x800_100_en";
  // As a signal sets it; when the first page is there.
  auto& stop = const_cast<std::atomic<bool>&>(interrupted());
  const std::filesystem::path pages = args.screenshots / args.only;
  std::jthread hand([&](const std::stop_token& over) {
    std::error_code error;
    const std::filesystem::directory_iterator none;
    while (!over.stop_requested() && std::filesystem::directory_iterator(pages, error) == none)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!over.stop_requested()) stop = true;
  });
  const Result<void> taken = take();
  hand.request_stop();
  hand.join();
  stop = false;
  ASSERT_FALSE(taken.has_value());
  EXPECT_EQ(taken.error().code, Errc::Cancelled) << taken.error().what.view();
  EXPECT_FALSE(std::filesystem::exists(args.screenshots / ("sheet_" + args.only + ".png"))) << "not all";
}

}  // namespace
}  // namespace relievo::firmware
