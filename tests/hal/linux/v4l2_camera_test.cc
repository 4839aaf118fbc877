// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The camera over a kernel that fails in every call, with every number a driver may give.
#include "hal/linux/v4l2_camera.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <memory>

#include <linux/videodev2.h>

#include "tests/support/kernel/v4l2_fake_kernel.h"

namespace relievo::hal {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

const CaptureMode kMode{64, 48, microseconds(4000)};

class V4l2CameraTest : public testing::Test {
 protected:
  ~V4l2CameraTest() override {
    camera.reset();
    EXPECT_EQ(kernel.open_files, 0) << "the device stays open";
    EXPECT_EQ(kernel.mapped, 0) << "a buffer stays mapped";
    EXPECT_TRUE(kernel.complaints.empty()) << kernel.complaints.front();
  }
  void make(V4l2CameraOptions options = {"/dev/v4l/by-path/left", {}, 0, true}) {
    camera = std::make_unique<V4l2Camera>(std::move(options), kernel, kernel.clock);
  }
  Errc error_of_open() {
    if (!camera) make();
    const auto opened = camera->open(kMode);
    EXPECT_FALSE(opened);
    if (opened) return Errc::Cancelled;
    EXPECT_EQ(camera->state(), Camera::State::Closed);
    EXPECT_EQ(kernel.open_files, 0);
    EXPECT_EQ(kernel.mapped, 0);
    EXPECT_EQ(opened.error().where(), "/dev/v4l/by-path/left");
    return opened.error().code;
  }
  void run() {
    make();
    const auto opened = camera->open(kMode);
    ASSERT_TRUE(opened) << opened.error().what.view();
    ASSERT_TRUE(camera->start());
  }
  Result<Frame> next() { return camera->next_frame(kernel.clock.now() + milliseconds(100)); }
  Errc error_of_next() {
    const auto frame = next();
    EXPECT_FALSE(frame);
    return frame ? Errc::Cancelled : frame.error().code;
  }

  FakeKernel kernel;
  std::unique_ptr<V4l2Camera> camera;
};

TEST_F(V4l2CameraTest, GivesTheDriversOwnMemoryStampAndNumber) {
  run();
  kernel.expose({1});
  kernel.clock.now_at += microseconds(33'333);
  const Instant second = kernel.clock.now();
  kernel.expose({2});
  EXPECT_TRUE(next());
  const auto frame = next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->image().row(47)[63], 2);
  EXPECT_EQ(frame->raw().stride_bytes, 80);
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
  EXPECT_EQ(camera->next_frame(kernel.clock.now() - milliseconds(1)).error().code, Errc::Timeout) << "a deadline gone by";
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

TEST_F(V4l2CameraTest, AnotherCameraThanTheCalibratedOneIsRefused) {
  make({"/dev/v4l/by-path/left", "B2", 0, true});
  EXPECT_EQ(error_of_open(), Errc::InvalidInput);
  kernel.serial = "B2";
  EXPECT_TRUE(camera->open(kMode));
}

TEST_F(V4l2CameraTest, SaysWhichCameraItIsAndAnewWhenItIsOpenedAgain) {
  make({"/dev/v4l/by-path/left", {}, 0, true});
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(camera->serial(), "A1");
  EXPECT_EQ(camera->socket(), "/dev/v4l/by-path/left");
  camera->close();
  kernel.serial = "B2";
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(camera->serial(), "B2");
  camera->close();
  make({"/dev/video0", {}, 0, true});
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(camera->socket(), "") << "another camera's name after another start";
}

TEST_F(V4l2CameraTest, DevicesThatAreNoUseAreRefusedInClearWords) {
  struct Case {
    std::function<void(FakeKernel&)> make;
    Errc code;
    const char* word;
  };
  const Case cases[] = {
      {[](FakeKernel& k) { k.is_camera = false; }, Errc::Unsupported, "index0"},
      {[](FakeKernel& k) { k.several_planes = true; }, Errc::Unsupported, "planes"},
      {[](FakeKernel& k) { k.streams = false; }, Errc::Unsupported, "stream"},
      {[](FakeKernel& k) { k.interlaced = true; }, Errc::Unsupported, "interlaced"},
      {[](FakeKernel& k) { k.has_timings = k.interlaced_signal = true; }, Errc::Unsupported, "interlaced"},
      {[](FakeKernel& k) { k.no_signal = true; }, Errc::Timeout, "signal"},
      {[](FakeKernel& k) { k.width_px = 128; }, Errc::Unsupported, "size"},
      {[](FakeKernel& k) { k.formats = {V4L2_PIX_FMT_H264}; }, Errc::Unsupported, "format"},
      {[](FakeKernel& k) { k.formats.clear(); }, Errc::Unsupported, "format"},
      {[](FakeKernel& k) { k.most_buffers = 1; }, Errc::OutOfMemory, "memory"},
  };
  for (const Case& c : cases) {
    FakeKernel spoilt;
    c.make(spoilt);
    V4l2Camera one({"x", {}, 0, true}, spoilt, spoilt.clock);
    const auto opened = one.open(kMode);
    ASSERT_FALSE(opened) << c.word;
    EXPECT_EQ(opened.error().code, c.code) << c.word;
    EXPECT_NE(opened.error().what.view().find(c.word), std::string_view::npos) << opened.error().what.view();
    EXPECT_EQ(spoilt.open_files + spoilt.mapped, 0) << c.word;
  }
}

TEST_F(V4l2CameraTest, InputsWithTimingsOnlyWorkAsWell) {
  kernel.has_timings = true;
  run();
  EXPECT_EQ(kernel.calls(KernelCall::SetTimings), 1);
  EXPECT_EQ(kernel.calls(KernelCall::SetInterval), 0);
  kernel.expose({});
  EXPECT_TRUE(next());
}

TEST_F(V4l2CameraTest, ADriverWithoutInputsOrIntervalsWorksAsWell) {
  kernel.fail(KernelCall::GetInput, ENOTTY);
  kernel.fail(KernelCall::GetInterval, ENOTTY);
  run();
  EXPECT_EQ(kernel.calls(KernelCall::SetInterval), 0);
}

TEST_F(V4l2CameraTest, TakesTheBestFormatOrTheOneAskedFor) {
  kernel.formats = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_H264, V4L2_PIX_FMT_SGBRG8};
  run();
  kernel.expose({});
  EXPECT_EQ(next()->raw().format, (RawFormat{RawCoding::Bits8, ColourFilter::Gbrg}));
  camera.reset();
  make({"/dev/v4l/by-path/left", {}, V4L2_PIX_FMT_GREY, true});
  ASSERT_TRUE(camera->open(kMode) && camera->start());
  kernel.expose({});
  EXPECT_EQ(next()->raw().format, RawFormat{});
}

TEST_F(V4l2CameraTest, TheExternalTriggerIsSetWhereTheDriverHasIt) {
  make();
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(kernel.set_controls.count(V4L2_CID_USER_BASE + 0x1010), 1U);
  camera.reset();
  kernel.set_controls.clear();
  make({"/dev/v4l/by-path/left", {}, 0, false});
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(kernel.set_controls.count(V4L2_CID_USER_BASE + 0x1010), 0U);
  camera.reset();
  kernel.trigger_control = "Trigger Happy Filter";
  make();
  EXPECT_TRUE(camera->open(kMode));
}

TEST_F(V4l2CameraTest, ExposureAndGainGoToTheSensorAndTheAutomaticsEnd) {
  make();
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(kernel.set_controls[V4L2_CID_EXPOSURE_ABSOLUTE], 40) << "4 ms in units of 0.1 ms";
  const auto limits = camera->exposure_limits();
  ASSERT_TRUE(limits);
  EXPECT_EQ(limits->least, (Exposure{microseconds(100), 1}));
  EXPECT_EQ(limits->most, (Exposure{microseconds(500'000), kGainSpan}));
  ASSERT_TRUE(camera->set_exposure({microseconds(8000), kGainSpan}));
  EXPECT_EQ(kernel.set_controls[V4L2_CID_EXPOSURE_AUTO], V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(kernel.set_controls[V4L2_CID_EXPOSURE_ABSOLUTE], 80);
  EXPECT_EQ(kernel.set_controls[V4L2_CID_GAIN], 255);
  ASSERT_TRUE(camera->set_exposure({microseconds(8000), 1}));
  EXPECT_EQ(kernel.set_controls[V4L2_CID_GAIN], 1);
  EXPECT_EQ(camera->set_exposure({microseconds(10), 1}).error().code, Errc::InvalidInput);
  EXPECT_EQ(camera->set_exposure({microseconds(8000), 99}).error().code, Errc::InvalidInput);
}

TEST_F(V4l2CameraTest, ACameraWithoutControlsOpensAllTheSame) {
  kernel.has_exposure = false;
  make();
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(camera->set_exposure({microseconds(4000), 1}).error().code, Errc::Unsupported);
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
