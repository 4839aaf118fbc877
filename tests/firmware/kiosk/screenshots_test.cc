// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The enrolment behind the pictures of all pages, on the simulated rig: what a person would pass by does not
// end it, what nobody can pass by is told in its own words. No GL: what is written is the head of the page
// that invites.
#include "firmware/demo/screenshots.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hal/clock.h"
#include "hal/sim/device.h"
#include "pipeline/calibrate/file/calibration_file.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/support/played_device.h"
#include "tests/support/small_device.h"
#include "tests/support/temporary_folder.h"

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
  EXPECT_FALSE(std::filesystem::exists(args.store / "relievo.running"));
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

}  // namespace
}  // namespace relievo::firmware
