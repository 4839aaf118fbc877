// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cameras that are unplugged and come back: how often they are tried, and what a screen says meanwhile.
#include "firmware/capture/stereo_grabber.h"

#include <gtest/gtest.h>

#include "firmware/work/jobs.h"
#include "tests/firmware/capture/grabber_fixture.h"

namespace relievo::firmware {
namespace {

using std::chrono::milliseconds;

class CameraLinkTest : public StereoGrabberTest {};

TEST_F(CameraLinkTest, ACameraThatVanishesIsOpenedAgainWithGrowingWaits) {
  right.script = {Fault::Vanish};
  const hal::Instant begin = clock.now();
  EXPECT_EQ(error_of_grab(), Errc::Disconnected);
  EXPECT_LT(clock.now() - begin, milliseconds(100)) << "a pulled plug is told at once";
  EXPECT_EQ(grabber.watch(), CameraWatch::RightGone);
  EXPECT_EQ(grabber.watch(), CameraWatch::RightGone);
  // A minute of asking: how long after one attempt comes the next?
  std::vector<milliseconds> waits;
  hal::Instant last = clock.now();
  for (int opens = right.opens; clock.now() - begin < std::chrono::minutes(1);
       clock.time += milliseconds(10)) {
    const auto started = grabber.start(kMode);
    ASSERT_FALSE(started);
    if (right.opens == opens) continue;
    opens = right.opens;
    waits.push_back(std::chrono::duration_cast<milliseconds>(clock.now() - last));
    last = clock.now();
  }
  ASSERT_GE(waits.size(), 8U);
  for (std::size_t i = 1; i < waits.size(); ++i) {
    const auto doubled = std::min<milliseconds>(2 * waits[i - 1], budget::kCameraRetryMost);
    EXPECT_NEAR(static_cast<double>(waits[i].count()), static_cast<double>(doubled.count()), 30.0) << i;
  }
  EXPECT_EQ(grabber.counts().right.refused, waits.size());
  right.plugged = true;
  clock.time += budget::kCameraRetryMost;
  EXPECT_TRUE(grabber.start(kMode));
  EXPECT_EQ(grabber.watch(), CameraWatch::Well);
  EXPECT_EQ(grabber.watch(), CameraWatch::Well);
  EXPECT_EQ(grabber.counts().right.returned, 1U);
  const auto pair = grabber.grab(slot, cancelled);
  EXPECT_TRUE(pair);
}

TEST_F(CameraLinkTest, BothCamerasMayVanishAndOneComeBackFirst) {
  left.script = {Fault::Vanish};
  EXPECT_EQ(error_of_grab(), Errc::Disconnected);
  right.plugged = false;
  clock.time += budget::kCameraRetryMost;
  left.plugged = true;
  ASSERT_TRUE(grabber.start(kMode)) << "the right one has not been asked yet";
  EXPECT_EQ(error_of_grab(), Errc::Disconnected);
  EXPECT_EQ(grabber.watch(), CameraWatch::RightGone);
  left.plugged = false;
  EXPECT_EQ(error_of_grab(), Errc::Disconnected);
  EXPECT_EQ(grabber.watch(), CameraWatch::BothGone);
}

TEST(CameraLink, ACameraThatNeverAnsweredIsAnErrorOfTheFirstAttempt) {
  HandClock clock;
  ScriptedCamera left{clock}, right{clock};
  ScriptedLine line{clock, left, right};
  right.plugged = false;
  StereoGrabber grabber{left, right, line, clock};
  EXPECT_EQ(grabber.start(kMode).error().code, Errc::NotFound);
  EXPECT_EQ(grabber.watch(), CameraWatch::Well) << "nothing has vanished";
  EXPECT_EQ(left.starts, 1) << "the other one is started nonetheless";
}

TEST_F(CameraLinkTest, TheJobWaitsForACameraThatVanishedAndSaysSoMeanwhile) {
  left.script = {Fault::Vanish};
  EXPECT_EQ(error_of_grab(), Errc::Disconnected);
  // Time passes with every question, and the camera returns after five seconds.
  class Passing final : public hal::Clock {
   public:
    Passing(HandClock& clock, ScriptedCamera& camera)
        : clock_(clock), camera_(camera), back_(clock.now() + std::chrono::seconds(5)) {}
    hal::Instant now() const override {
      clock_.time += milliseconds(500);
      if (clock_.time > back_) camera_.plugged = true;
      return clock_.time;
    }
    std::chrono::system_clock::time_point wall_now() const override { return {}; }

   private:
    HandClock& clock_;
    ScriptedCamera& camera_;
    hal::Instant back_;
  } passing(clock, left);
  FunctionJob job([&](JobControl& c) { return open_cameras(grabber, kMode, passing, c); });
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  cancelled = true;
  EXPECT_EQ(job.run(control).error().code, Errc::Cancelled);
  EXPECT_EQ(grabber.watch(), CameraWatch::LeftGone);
  cancelled = false;
  EXPECT_TRUE(job.run(control));
  EXPECT_EQ(grabber.watch(), CameraWatch::Well);
}

}  // namespace
}  // namespace relievo::firmware
