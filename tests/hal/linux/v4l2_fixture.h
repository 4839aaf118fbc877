// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// V4l2Fixture: one camera over a kernel that fails in every call, with every number a driver may give. When a
// test ends it looks that nothing stays open, mapped or queued twice.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <utility>

#include "hal/linux/v4l2_camera.h"
#include "tests/support/kernel/v4l2_fake_kernel.h"

namespace relievo::hal {

inline const CaptureMode kMode{64, 48, std::chrono::microseconds(4000)};

class V4l2Fixture : public testing::Test {
 protected:
  ~V4l2Fixture() override {
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
  Result<Frame> next() { return camera->next_frame(kernel.clock.now() + std::chrono::milliseconds(100)); }
  Errc error_of_next() {
    const auto frame = next();
    EXPECT_FALSE(frame);
    return frame ? Errc::Cancelled : frame.error().code;
  }

  FakeKernel kernel;
  std::unique_ptr<V4l2Camera> camera;
};

}  // namespace relievo::hal
