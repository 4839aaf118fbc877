// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A StereoGrabber on the scripted rig, running.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "firmware/capture/stereo_grabber.h"
#include "tests/firmware/capture/scripted_rig.h"

namespace relievo::firmware {

inline constexpr hal::CaptureMode kMode{8, 8, std::chrono::microseconds(100)};

class StereoGrabberTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(grabber.start(kMode)); }
  Errc error_of_grab() {
    const auto pair = grabber.grab(slot, cancelled);
    EXPECT_FALSE(pair);
    EXPECT_EQ(left.held + right.held, 0) << "a sensor buffer was kept";
    return pair ? Errc::Unsupported : pair.error().code;
  }
  // Both pictures of the pair are of this pulse.
  void expect_pair_of_pulse(int number) {
    const auto pair = grabber.grab(slot, cancelled);
    ASSERT_TRUE(pair) << pair.error().what.view();
    EXPECT_EQ(pair->left.row(7)[7], number);
    EXPECT_EQ(pair->right.row(7)[7], number);
    EXPECT_EQ(left.held + right.held, 0);
  }
  const CameraCounts& of_left() const { return grabber.counts().left; }

  HandClock clock;
  ScriptedCamera left{clock};
  ScriptedCamera right{clock};
  ScriptedLine line{clock, left, right};
  std::vector<std::byte> memory = std::vector<std::byte>(7 * 8 * 8);
  StereoSlot slot{memory};
  std::atomic<bool> cancelled{false};
  StereoGrabber grabber{
      left, right, line, clock, {.wait = [this](hal::Instant until, const std::atomic<bool>&) {
        clock.time = std::max(clock.time, until);
      }}};
};

}  // namespace relievo::firmware
