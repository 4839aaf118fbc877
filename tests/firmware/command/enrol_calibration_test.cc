// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who enrols by command without a calibration, or with an algorithm that is none, is told so before anything
// is made.
#include <gtest/gtest.h>

#include <filesystem>

#include "firmware/command/commands.h"
#include "hal/clock.h"
#include "storage/sqlite/sqlite_store.h"
#include "tests/support/played_device.h"
#include "tests/support/temporary_folder.h"

namespace relievo::firmware {
namespace {

TEST(EnrolCalibration, OfASimulatedRigThatNobodyKnowsIsMissing) {
  const test::TemporaryFolder folder;
  const hal::MonotonicClock clock;
  test::PlayedWorld world;
  Console console;
  Services services{.console = console, .clock = clock};
  services.open_device = [&world](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
    return std::unique_ptr<hal::Device>(std::make_unique<test::PlayedDevice>(world, 640, 480));
  };
  services.open_store = [&clock](const Path& at, bool to_write) {
    return storage::open_sqlite_store(
        at, clock,
        {.mode = to_write ? storage::OpenMode::ReadWrite : storage::OpenMode::ReadOnly, .reserve_bytes = 0});
  };
  EnrolArgs args;
  args.subject = "Ada";
  args.device = "sim";
  args.store = folder.path() / "store";
  const Result<void> enrolled = run(args, services);
  ASSERT_FALSE(enrolled);
  EXPECT_EQ(enrolled.error().code, Errc::NotCalibrated);
  EXPECT_FALSE(std::filesystem::exists(args.store));
}

TEST(EnrolAlgorithms, AreLookedAtBeforeADeviceIsOpened) {
  const hal::MonotonicClock clock;
  Console console;
  Services services{.console = console, .clock = clock};
  bool touched = false;
  services.open_device = [&touched](std::string_view) -> Result<std::unique_ptr<hal::Device>> {
    touched = true;
    return Error{Errc::Disconnected, "as the test says"};
  };
  EnrolArgs args;
  args.subject = "Ada";
  args.store = "/nowhere";
  EXPECT_FALSE(run(args, services));
  EXPECT_TRUE(touched);
  for (const char* wrong : {"matcher=foo", "zmncc.window_px=-1"}) {
    touched = false;
    args.algorithms.settings = {wrong};
    EXPECT_FALSE(run(args, services)) << wrong;
    EXPECT_FALSE(touched) << wrong;
  }
}

}  // namespace
}  // namespace relievo::firmware
