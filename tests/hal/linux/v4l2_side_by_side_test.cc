// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/side_by_side.h"

#include <gtest/gtest.h>

#include <linux/videodev2.h>

#include "hal/linux/v4l2_camera.h"
#include "tests/support/kernel/v4l2_fake_kernel.h"

namespace relievo::hal {
namespace {

using std::chrono::milliseconds;

const CaptureMode kView{32, 48, {}};

class SideBySideTest : public testing::Test {
 protected:
  SideBySideTest() { kernel.most_buffers = 4; }
  void run() {
    for (Camera* camera : {&both.left(), &both.right()}) ASSERT_TRUE(camera->open(kView) && camera->start());
  }
  Result<Frame> next(Camera& camera) { return camera.next_frame(kernel.clock.now() + milliseconds(50)); }

  FakeKernel kernel;
  V4l2Camera device{{"both", {}, 0, false}, kernel, kernel.clock};
  SideBySide both{device};
};

TEST_F(SideBySideTest, EachPictureIsHandedOutTwiceWithoutCopying) {
  run();
  EXPECT_EQ(kernel.open_files, 1);
  for (int i = 1; i <= 20; ++i) {
    kernel.expose({static_cast<std::uint8_t>(i)});
    const auto left = next(both.left());
    const auto right = next(both.right());
    ASSERT_TRUE(left && right);
    EXPECT_EQ(left->raw().width_px, 32);
    EXPECT_EQ(right->raw().bytes - left->raw().bytes, 32) << "the same memory";
    EXPECT_EQ(left->raw().stride_bytes, right->raw().stride_bytes);
    EXPECT_EQ(left->exposed_at(), right->exposed_at());
    EXPECT_EQ(left->sequence(), right->sequence());
    EXPECT_FALSE(is_short(left->raw()) || is_short(right->raw()));
    EXPECT_EQ(left->raw().bytes[47 * left->raw().stride_bytes + 31], std::byte(i));
    EXPECT_EQ(kernel.queued(), 3);
  }
  EXPECT_EQ(kernel.queued(), 4);
}

TEST_F(SideBySideTest, ACutPictureIsShortOnBothSides) {
  run();
  kernel.expose({1, false, 80 * 20});
  const auto left = next(both.left());
  const auto right = next(both.right());
  ASSERT_TRUE(left && right);
  EXPECT_TRUE(is_short(left->raw()) && is_short(right->raw()));
}

TEST_F(SideBySideTest, ASideThatIsAskedLessOftenFindsTheNewest) {
  run();
  for (const int i : {1, 2, 3}) {
    kernel.expose({static_cast<std::uint8_t>(i)});
    ASSERT_TRUE(next(both.left()));
  }
  EXPECT_EQ(next(both.right())->raw().bytes[0], std::byte{3});
  EXPECT_EQ(kernel.queued(), 4);
  EXPECT_EQ(next(both.right()).error().code, Errc::Timeout) << "and each picture once";
}

TEST_F(SideBySideTest, OneSideMayStopAndStart) {
  run();
  kernel.expose({1});
  ASSERT_TRUE(next(both.left()));
  both.right().stop();
  EXPECT_EQ(kernel.queued(), 4) << "nobody waits for the right half any more";
  EXPECT_TRUE(kernel.streaming);
  both.left().stop();
  EXPECT_FALSE(kernel.streaming);
  ASSERT_TRUE(both.left().start() && both.right().start());
  kernel.expose({2});
  EXPECT_TRUE(next(both.right()));
  EXPECT_EQ(next(both.left())->raw().bytes[0], std::byte{2});
}

TEST_F(SideBySideTest, HeldHalvesRunOutAndComeBack) {
  run();
  std::vector<Frame> held;
  for (int i = 0; i < 3; ++i) {
    kernel.expose({});
    auto frame = next(both.left());
    ASSERT_TRUE(frame);
    held.push_back(*std::move(frame));
  }
  kernel.expose({});
  EXPECT_EQ(next(both.left()).error().code, Errc::Timeout);
  held.clear();
  EXPECT_TRUE(next(both.left()));
}

// The device vanishes; whichever side notices first, both come back.
TEST_F(SideBySideTest, UnpluggedAndPluggedInAgain) {
  for (const bool left_first : {true, false}) {
    run();
    kernel.unplug();
    Camera& first = left_first ? both.left() : both.right();
    Camera& second = left_first ? both.right() : both.left();
    EXPECT_EQ(next(first).error().code, Errc::Disconnected);
    first.close();
    EXPECT_EQ(kernel.open_files, 0) << "a dead file keeps the device from coming back";
    EXPECT_EQ(next(second).error().code, Errc::Disconnected);
    second.close();
    EXPECT_EQ(first.open(kView).error().code, Errc::NotFound);
    kernel.plug_in();
    run();
    kernel.expose({7});
    EXPECT_TRUE(next(first));
    EXPECT_TRUE(next(second));
    first.close();
    second.close();
    EXPECT_EQ(kernel.open_files, 0);
  }
  EXPECT_TRUE(kernel.complaints.empty()) << kernel.complaints.front();
}

TEST_F(SideBySideTest, WhatCannotBeHalvedIsRefusedInClearWords) {
  kernel.formats = {V4L2_PIX_FMT_MJPEG};
  run();
  kernel.expose({});
  const auto half = next(both.left());
  ASSERT_FALSE(half);
  EXPECT_EQ(half.error().code, Errc::Unsupported);
  EXPECT_NE(half.error().what.view().find("JPEG"), std::string_view::npos);
}

}  // namespace
}  // namespace relievo::hal
