// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures: as the driver stamped and numbered them, until the camera is unplugged.
#include <cerrno>
#include <vector>

#include <linux/videodev2.h>

#include "tests/hal/linux/v4l2_fixture.h"

namespace relievo::hal {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

using V4l2CameraTest = V4l2Fixture;

TEST_F(V4l2CameraTest, GivesTheDriversOwnMemoryStampAndNumber) {
  run();
  kernel.expose({1});
  kernel.clock.now_at += microseconds(33'333);
  const Instant second = kernel.clock.now();
  kernel.expose({2});
  EXPECT_TRUE(next());
  const auto frame = next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->raw().stride_bytes, 80);
  EXPECT_EQ(frame->raw().bytes[47 * 80 + 63], std::byte{2});
  EXPECT_EQ(frame->sequence(), 1U);
  EXPECT_EQ(frame->exposed_at(), second);
  EXPECT_EQ(camera->serial(), "A1");
}

TEST_F(V4l2CameraTest, AFrameGivenBackIsQueuedAtOnce) {
  run();
  EXPECT_EQ(kernel.queued(), 4);
  kernel.expose({1});
  {
    const auto frame = next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(kernel.queued(), 3);
  }
  EXPECT_EQ(kernel.queued(), 4);
}

TEST_F(V4l2CameraTest, HoldingEveryFrameStopsItUntilOneIsGivenBack) {
  run();
  std::vector<Frame> held;
  for (int i = 0; i < 4; ++i) {
    kernel.expose({});
    auto frame = next();
    ASSERT_TRUE(frame);
    held.push_back(*std::move(frame));
  }
  kernel.expose({});  // no buffer: the driver drops it, and counts
  EXPECT_EQ(error_of_next(), Errc::Timeout);
  held.pop_back();
  kernel.expose({});
  const auto frame = next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->sequence(), 5U);
}

TEST_F(V4l2CameraTest, WithoutAPulseTheDeadlineComes) {
  run();
  const Instant deadline = kernel.clock.now() + milliseconds(100);
  EXPECT_EQ(error_of_next(), Errc::Timeout);
  EXPECT_GE(kernel.clock.now(), deadline);
  EXPECT_EQ(camera->next_frame(kernel.clock.now() - milliseconds(1)).error().code, Errc::Timeout)
      << "a deadline gone by";
}

TEST_F(V4l2CameraTest, DamagedAndShortPicturesAreHandedOnAsSuch) {
  run();
  kernel.expose({1, true, 0});
  kernel.expose({1, false, 100});
  EXPECT_TRUE(next()->damaged());
  const auto cut = next();
  ASSERT_TRUE(cut);
  EXPECT_TRUE(is_short(cut->raw()));
}

TEST_F(V4l2CameraTest, UnpluggedAndPluggedInAgain) {
  run();
  kernel.unplug();
  EXPECT_EQ(error_of_next(), Errc::Disconnected);
  camera->close();
  EXPECT_EQ(camera->open(kMode).error().code, Errc::NotFound);
  kernel.plug_in();
  ASSERT_TRUE(camera->open(kMode) && camera->start());
  kernel.expose({9});
  EXPECT_TRUE(next());
}

TEST_F(V4l2CameraTest, StopAndStartTakesEveryBufferAlong) {
  run();
  kernel.expose({});
  kernel.expose({});
  {
    const auto held = next();
    camera->stop();
    ASSERT_TRUE(camera->start());
    EXPECT_EQ(kernel.queued(), 3);
  }
  EXPECT_EQ(kernel.queued(), 4);
}

TEST_F(V4l2CameraTest, TimeStampsOfNoKnownClockAreRefusedAndTheBufferGoesBack) {
  kernel.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  run();
  kernel.expose({});
  EXPECT_EQ(error_of_next(), Errc::Unsupported);
  EXPECT_EQ(kernel.queued(), 4);
}

TEST_F(V4l2CameraTest, ASecondCameraWithoutRoomOnTheBusIsToldSo) {
  make();
  ASSERT_TRUE(camera->open(kMode));
  kernel.fail(KernelCall::StreamOn, ENOSPC);
  const auto started = camera->start();
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().what.view().find("bus"), std::string_view::npos);
  EXPECT_EQ(kernel.queued(), 0);
  EXPECT_TRUE(camera->start()) << "once there is room";
  EXPECT_EQ(kernel.queued(), 4);
}

TEST_F(V4l2CameraTest, SignalsAreNoErrors) {
  make();
  for (int c = 1; c < static_cast<int>(KernelCall::Count); ++c)
    if (static_cast<KernelCall>(c) != KernelCall::Map) kernel.fail(static_cast<KernelCall>(c), EINTR);
  ASSERT_TRUE(camera->open(kMode) && camera->start());
  kernel.expose({5});
  EXPECT_TRUE(next());
}

}  // namespace
}  // namespace relievo::hal
