// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/stereo_grabber.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "hal/linux/side_by_side.h"
#include "hal/linux/v4l2_camera.h"
#include "tests/support/kernel/v4l2_fake_kernel.h"
#include "tests/support/played_device.h"

namespace relievo::firmware {
namespace {

using hal::FakeKernel;
using hal::V4l2Camera;
using pipeline::RigCameras;

const hal::CaptureMode kPluggedMode{64, 48, std::chrono::microseconds(4000)};

// Two cameras of Linux's video interface, each on a kernel that says what the test says.
struct Plugged {
  FakeKernel left_kernel, right_kernel;
  V4l2Camera left, right;
  Plugged(const char* left_serial, const char* right_serial, const char* left_at = "/dev/v4l/by-path/a",
          const char* right_at = "/dev/v4l/by-path/b")
      : left({left_at, {}, 0, true}, left_kernel, left_kernel.clock),
        right({right_at, {}, 0, true}, right_kernel, right_kernel.clock) {
    left_kernel.serial = left_serial;
    right_kernel.serial = right_serial;
    EXPECT_TRUE(left.open(kPluggedMode) && right.open(kPluggedMode));
  }
  RigCameras names() const { return cameras_of(left, right); }
};

TEST(RigCameras, ASerialNumberTellsACameraWhereverItIsPluggedIn) {
  const Plugged here("A1", "B2"), there("A1", "B2", "/dev/v4l/by-path/c", "/dev/v4l/by-path/d");
  EXPECT_EQ(here.names(), (RigCameras{"serial A1", "serial B2"}));
  EXPECT_TRUE(check_cameras(here.names(), there.names()));
}

TEST(RigCameras, WithoutOneOrWithTheSameOnBothItIsTheSocket) {
  EXPECT_EQ(Plugged("", "").names(), (RigCameras{"at /dev/v4l/by-path/a", "at /dev/v4l/by-path/b"}));
  EXPECT_EQ(Plugged("01.00.00", "01.00.00").names(),
            (RigCameras{"at /dev/v4l/by-path/a", "at /dev/v4l/by-path/b"}));
  EXPECT_EQ(Plugged("", "B2").names(), (RigCameras{"at /dev/v4l/by-path/a", "serial B2"}));
  EXPECT_EQ(Plugged("", "", "/dev/video0", "/dev/video2").names(), RigCameras())
      << "names that another start gives to others";
}

TEST(RigCameras, OneDeviceOfBothViewsIsToldByItsSerialNumber) {
  FakeKernel kernel;
  kernel.serial = "C3";
  V4l2Camera device({"/dev/v4l/by-path/c", {}, 0, true}, kernel, kernel.clock);
  hal::SideBySide both(device);
  ASSERT_TRUE(both.left().open({32, 48, std::chrono::microseconds(4000)}) &&
              both.right().open({32, 48, std::chrono::microseconds(4000)}));
  EXPECT_EQ(cameras_of(both.left(), both.right()), (RigCameras{"serial C3", "serial C3"}));
}

TEST(RigCameras, AnotherCameraIsToldBySideWithWhatWasExpectedAndWhatToDo) {
  const RigCameras calibrated = Plugged("A1", "B2").names();
  struct Case {
    const char *left, *right, *words, *where;
  };
  for (const Case& c : {Case{"X9", "B2", "the left camera", "serial A1 → serial X9"},
                        Case{"A1", "Y8", "the right camera", "serial B2 → serial Y8"},
                        Case{"X9", "Y8", "neither camera", "serial B2 → serial Y8"},
                        Case{"B2", "A1", "changed places", "serial A1 → serial B2"},
                        Case{"A1", "", "the right camera", "serial B2 → at /dev/v4l/by-path/b"}}) {
    const Result<void> checked = check_cameras(calibrated, Plugged(c.left, c.right).names());
    ASSERT_FALSE(checked) << c.words;
    EXPECT_EQ(checked.error().code, Errc::NotCalibrated);
    EXPECT_NE(checked.error().what.view().find(c.words), std::string_view::npos)
        << checked.error().what.view();
    EXPECT_NE(checked.error().what.view().find("calibrate again"), std::string_view::npos);
    EXPECT_NE(checked.error().where().find(c.where), std::string_view::npos) << checked.error().where();
  }
}

// A calibration of before, and cameras that say nothing of themselves.
TEST(RigCameras, OfWhatNobodyKnowsNothingIsSaid) {
  const RigCameras known{"serial A1", "serial B2"};
  EXPECT_TRUE(check_cameras({}, known));
  EXPECT_TRUE(check_cameras(known, {}));
  EXPECT_TRUE(check_cameras({"", "serial B2"}, known));
  EXPECT_FALSE(check_cameras({"", "serial C3"}, known));
}

// At the start, and each time a camera is opened again.
TEST(RigCameras, TheGrabberRecognisesThemAndGrabsAllTheSame) {
  test::PlayedWorld world;
  test::PlayedDevice device(world, 64, 48);
  device.left_camera.number = "A1";
  device.right_camera.number = "B2";
  StereoGrabber grabber(device);
  grabber.expect({"serial A1", "serial B2"});
  EXPECT_TRUE(grabber.check_cameras()) << "nobody knows yet";
  ASSERT_TRUE(grabber.start(device.preferred_mode()));
  EXPECT_EQ(grabber.cameras(), (RigCameras{"serial A1", "serial B2"}));
  EXPECT_TRUE(grabber.check_cameras());
  std::vector<std::byte> memory(std::size_t{2} << 20);
  StereoSlot slot(memory);
  const std::atomic<bool> never{false};
  ASSERT_TRUE(grabber.grab(slot, never));

  world.pulled = true;
  EXPECT_EQ(grabber.grab(slot, never).error().code, Errc::Disconnected);
  device.right_camera.number = "Y8";
  world.pulled = false;
  world.ahead_s = 60;  // whatever is waited before it is tried again
  ASSERT_TRUE(grabber.start(device.preferred_mode()));
  const Result<void> checked = grabber.check_cameras();
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().where(), "serial B2 → serial Y8");
  EXPECT_TRUE(grabber.grab(slot, never)) << "who calibrates anew needs it";
  grabber.expect(grabber.cameras());
  EXPECT_TRUE(grabber.check_cameras());
}

TEST(RigCameras, WhatACameraSaysOfItselfIsKeptAsWordsOfBoundedLength) {
  const std::string strange = "A\n\xff" + std::string(400, 'x') + "end";
  const RigCameras names = Plugged(strange.c_str(), "B\t2").names();
  EXPECT_EQ(names.left.size(), pipeline::kMaxCameraWords);
  EXPECT_TRUE(names.left.ends_with("xend"));
  EXPECT_EQ(names.right, "serial B?2");
}

}  // namespace
}  // namespace relievo::firmware
