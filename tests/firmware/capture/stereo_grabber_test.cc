// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cameras that fail on purpose: what a person and a technician are told in each case.
#include "firmware/capture/stereo_grabber.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "firmware/budget.h"

namespace relievo::firmware {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

class HandClock final : public hal::Clock {
 public:
  hal::Instant time{};
  hal::Instant now() const override { return time; }
  std::chrono::system_clock::time_point wall_now() const override { return {}; }
};

class FakeLine final : public hal::TriggerLine {
 public:
  int pulses = 0;
  bool broken = false;
  Result<void> pulse(std::chrono::microseconds) override {
    ++pulses;
    if (broken) return Error{Errc::IoFailed, "the trigger line does not answer"};
    return {};
  }
};

// Plays a list of exposures; afterwards every wait ends in a timeout, which the clock feels.
class FakeCamera final : public hal::Camera {
 public:
  struct Shot {
    microseconds exposed_at{0};
    std::optional<Errc> error;
    int width_px = 8;
  };
  FakeCamera(HandClock& clock, std::uint8_t shade) : clock_(clock), pixels_(64 * 8, std::byte{shade}) {}
  std::deque<Shot> shots;
  int starts = 0;
  int held = 0;

 private:
  Result<void> do_open(const hal::CaptureMode&) override { return {}; }
  Result<void> do_start() override {
    ++starts;
    return {};
  }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant deadline) override {
    if (shots.empty()) {
      clock_.time = std::max(clock_.time, deadline);
      return Error{Errc::Timeout, "no picture came"};
    }
    const Shot shot = shots.front();
    shots.pop_front();
    if (shot.error) return Error{*shot.error, "the camera is gone: check its plug"};
    ++held;
    // 64 bytes a row: more than the picture is wide, as sensors pad.
    return hal::Frame({pixels_.data(), shot.width_px, 8, 64, PixelFormat::Grey8},
                      hal::Instant{} + shot.exposed_at, ++sequence_,
                      [](void* owner, int) { --static_cast<FakeCamera*>(owner)->held; }, this, 0);
  }

  HandClock& clock_;
  std::vector<std::byte> pixels_;
  std::uint32_t sequence_ = 0;
};

class StereoGrabberTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(grabber.start({8, 8, microseconds(100)})); }
  Errc error_of_grab() {
    const auto pair = grabber.grab(slot, cancelled);
    EXPECT_FALSE(pair);
    EXPECT_EQ(left.held + right.held, 0) << "a sensor buffer was kept";
    return pair ? Errc::Unsupported : pair.error().code;
  }

  HandClock clock;
  FakeLine line;
  FakeCamera left{clock, 10};
  FakeCamera right{clock, 20};
  std::vector<std::byte> memory = std::vector<std::byte>(2 * 8 * 8);
  StereoSlot slot{memory};
  std::atomic<bool> cancelled{false};
  StereoGrabber grabber{left, right, line, clock};
};

TEST_F(StereoGrabberTest, CopiesBothPicturesOnceAndReturnsTheBuffers) {
  left.shots = {{microseconds(1000), {}, 8}};
  right.shots = {{microseconds(1400), {}, 8}};
  const auto pair = grabber.grab(slot, cancelled);
  ASSERT_TRUE(pair);
  EXPECT_EQ(line.pulses, 1);
  EXPECT_EQ(pair->skew_ns, 400'000);
  EXPECT_EQ(pair->left.bytes, memory.data());
  EXPECT_EQ(pair->left.stride_bytes, 8);
  EXPECT_EQ(pair->left.row(7)[7], 10);
  EXPECT_EQ(pair->right.row(7)[7], 20);
  EXPECT_EQ(left.held + right.held, 0);
}

TEST_F(StereoGrabberTest, DropsAPictureThatHasLostItsPartner) {
  left.shots = {{microseconds(1000), {}, 8}, {microseconds(34'000), {}, 8}};
  right.shots = {{microseconds(34'100), {}, 8}};
  const auto pair = grabber.grab(slot, cancelled);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->sequence, 2U);
  EXPECT_EQ(pair->skew_ns, 100'000);
}

TEST_F(StereoGrabberTest, PicturesThatNeverMeetAreATimeout) {
  for (int i = 0; i < 500; ++i) {
    left.shots.push_back({milliseconds(33 * i), {}, 8});
    right.shots.push_back({milliseconds(33 * i + 16), {}, 8});
  }
  EXPECT_EQ(error_of_grab(), Errc::Timeout);
}

TEST_F(StereoGrabberTest, NoPictureIsATimeoutAndTheStreamsStartAnew) {
  left.shots = {{microseconds(1000), {}, 8}};
  EXPECT_EQ(error_of_grab(), Errc::Timeout);
  EXPECT_GE(clock.time - hal::Instant{}, budget::kFrameWait);
  EXPECT_EQ(left.starts, 2);
  EXPECT_EQ(right.starts, 2);
  EXPECT_EQ(left.state(), hal::Camera::State::Running);
}

TEST_F(StereoGrabberTest, APulledPlugIsToldAtOnce) {
  left.shots = {{microseconds(1000), {}, 8}};
  right.shots = {{microseconds(0), Errc::Disconnected, 8}};
  EXPECT_EQ(error_of_grab(), Errc::Disconnected);
  EXPECT_EQ(clock.time, hal::Instant{});
}

TEST_F(StereoGrabberTest, ViewsOfDifferentSizesAreRefused) {
  left.shots = {{microseconds(1000), {}, 8}};
  right.shots = {{microseconds(1000), {}, 6}};
  EXPECT_EQ(error_of_grab(), Errc::InvalidInput);
}

TEST_F(StereoGrabberTest, APictureLargerThanItsRoomIsRefused) {
  left.shots = {{microseconds(1000), {}, 16}};
  right.shots = {{microseconds(1000), {}, 16}};
  EXPECT_EQ(error_of_grab(), Errc::InvalidInput);
}

TEST_F(StereoGrabberTest, ABrokenTriggerIsTold) {
  line.broken = true;
  EXPECT_EQ(error_of_grab(), Errc::IoFailed);
}

TEST_F(StereoGrabberTest, CancelEndsTheWait) {
  cancelled.store(true);
  EXPECT_EQ(error_of_grab(), Errc::Cancelled);
  cancelled.store(false);
  left.shots = {{microseconds(1000), {}, 8}};
  right.shots = {{microseconds(1000), {}, 8}};
  EXPECT_TRUE(grabber.grab(slot, cancelled));
}

TEST_F(StereoGrabberTest, WipeLeavesNoPixel) {
  left.shots = {{microseconds(1000), {}, 8}};
  right.shots = {{microseconds(1000), {}, 8}};
  ASSERT_TRUE(grabber.grab(slot, cancelled));
  slot.wipe();
  for (const std::byte b : memory) ASSERT_EQ(b, std::byte{0});
}

}  // namespace
}  // namespace relievo::firmware
