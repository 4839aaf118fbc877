// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is opened: which camera, which of its formats, its trigger, exposure and gain.
#include <cerrno>
#include <functional>

#include <linux/videodev2.h>

#include "tests/hal/linux/v4l2_fixture.h"

namespace relievo::hal {
namespace {

using std::chrono::microseconds;

using V4l2OpenTest = V4l2Fixture;

TEST_F(V4l2OpenTest, AnotherCameraThanTheCalibratedOneIsRefused) {
  make({"/dev/v4l/by-path/left", "B2", 0, true});
  EXPECT_EQ(error_of_open(), Errc::InvalidInput);
  kernel.serial = "B2";
  EXPECT_TRUE(camera->open(kMode));
}

TEST_F(V4l2OpenTest, SaysWhichCameraItIsAndAnewWhenItIsOpenedAgain) {
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

TEST_F(V4l2OpenTest, DevicesThatAreNoUseAreRefusedInClearWords) {
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

TEST_F(V4l2OpenTest, ASignalThatInterruptsTheOpeningIsNoError) {
  kernel.fail(KernelCall::Open, EINTR);
  run();
  EXPECT_EQ(kernel.calls(KernelCall::Open), 2);
}

TEST_F(V4l2OpenTest, InputsWithTimingsOnlyWorkAsWell) {
  kernel.has_timings = true;
  run();
  EXPECT_EQ(kernel.calls(KernelCall::SetTimings), 1);
  EXPECT_EQ(kernel.calls(KernelCall::SetInterval), 0);
  kernel.expose({});
  EXPECT_TRUE(next());
}

TEST_F(V4l2OpenTest, ADriverWithoutInputsOrIntervalsWorksAsWell) {
  kernel.fail(KernelCall::GetInput, ENOTTY);
  kernel.fail(KernelCall::GetInterval, ENOTTY);
  run();
  EXPECT_EQ(kernel.calls(KernelCall::SetInterval), 0);
}

TEST_F(V4l2OpenTest, TakesTheBestFormatOrTheOneAskedFor) {
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

TEST_F(V4l2OpenTest, TheExternalTriggerIsSetWhereTheDriverHasIt) {
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

TEST_F(V4l2OpenTest, OfATriggerMenuTheEntryOfTheOutsideIsChosen) {
  const struct {
    std::vector<std::string> menu;
    std::int32_t chosen;
  } kCases[] = {{{"Continuous", "Software", "External Line 0"}, 2},
                {{"Off", "On"}, 1},
                {{"Master", "", "Slave"}, 2},
                {{"Free Run", "Hardware Trigger"}, 1},
                {{"Mode 0", "Mode 1", "Mode 2"}, 1}};
  for (const auto& c : kCases) {
    kernel.trigger_menu = c.menu;
    make();
    ASSERT_TRUE(camera->open(kMode));
    EXPECT_EQ(kernel.set_controls[V4L2_CID_USER_BASE + 0x1010], c.chosen) << c.menu.front();
    camera.reset();
  }
}

TEST_F(V4l2OpenTest, ExposureAndGainGoToTheSensorAndTheAutomaticsEnd) {
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

TEST_F(V4l2OpenTest, ACameraWithoutControlsOpensAllTheSame) {
  kernel.has_exposure = false;
  make();
  ASSERT_TRUE(camera->open(kMode));
  EXPECT_EQ(camera->set_exposure({microseconds(4000), 1}).error().code, Errc::Unsupported);
}

}  // namespace
}  // namespace relievo::hal
