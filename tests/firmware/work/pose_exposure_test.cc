// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// While somebody poses, both cameras are set to one exposure by the light they see; for the burst nobody changes it. Two cameras that add
// up light as sensors do, before a scene in which no face is found: metered is the middle.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <vector>

#include "firmware/work/jobs.h"
#include "hal/monotonic_clock.h"
#include "tests/support/played_board.h"

namespace relievo::firmware {
namespace {

using std::chrono::microseconds;

constexpr int kWidth = 160, kHeight = 120;

class LitCamera final : public hal::Camera {
 public:
  LitCamera(const hal::Instant& pulsed_at, double gain) : pulsed_at_(pulsed_at), own_(gain), pixels_(std::size_t{kWidth} * kHeight) {}
  double lamp = 1;
  hal::Exposure set;
  int sets = 0, pictures = 0;
  std::function<void()> on_picture;
  std::vector<hal::Exposure> exposed;  // of each picture

 private:
  Result<void> do_open(const hal::CaptureMode&) override { return {}; }
  Result<void> do_start() override { return {}; }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant) override {
    ++pictures;
    if (on_picture) on_picture();
    exposed.push_back(set);
    const double light = lamp * own_ * static_cast<double>(set.time.count()) * set.gain / 10'000;
    // Dark at the sides, where nobody stands; in the middle grains of 0.25 to 0.6.
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double grain = std::abs(x - kWidth / 2) < kWidth / 4 ? 0.25 + 0.35 * ((x * 7 + y * 13) % 16) / 15.0 : 0.01;
        pixels_[static_cast<std::size_t>(y * kWidth + x)] = static_cast<std::byte>(std::min(255.0, 255 * grain * light));
      }
    return hal::Frame({pixels_.data(), pixels_.size(), kWidth, kHeight, kWidth, {}}, {pulsed_at_, ++sequence_}, [](void*, int) {}, this, 0);
  }
  Result<void> do_set_exposure(const hal::Exposure& exposure) override {
    set = exposure;
    ++sets;
    return {};
  }
  Result<hal::ExposureLimits> do_exposure_limits() const override { return hal::ExposureLimits{{microseconds(50), 1}, {microseconds(30'000), 16}}; }

  const hal::Instant& pulsed_at_;
  double own_;   // how much more than the other it sees
  std::vector<std::byte> pixels_;
  std::uint32_t sequence_ = 0;
};

class LitBoard final : public hal::Board, hal::RemovableMedia, hal::Watchdog {
 public:
  test::PlayedWorld world;
  test::PlayedClock time{world};
  test::PlayedLine line{time};
  LitCamera left_camera{line.pulsed_at, 1}, right_camera{line.pulsed_at, 1.2};
  std::string_view name() const override { return "lit"; }
  hal::CaptureMode preferred_mode() const override { return {kWidth, kHeight, microseconds(1)}; }
  hal::Camera& left() override { return left_camera; }
  hal::Camera& right() override { return right_camera; }
  hal::TriggerLine& trigger() override { return line; }
  hal::RemovableMedia& media() override { return *this; }
  hal::Clock& clock() override { return time; }
  hal::Watchdog& watchdog() override { return *this; }

 private:
  std::optional<hal::Medium> current() override { return std::nullopt; }
  Result<void> flush_and_eject() override { return {}; }
  void kick() override {}
};

pipeline::StereoCalibration calibration() {
  pipeline::StereoCalibration c;
  c.left = c.right = {{245, 245}, {kWidth / 2.0, kHeight / 2.0}, {}, kWidth, kHeight};
  // Turned towards each other, so that both see a face at 560 mm.
  const double turn = 0.245, sine = std::sin(turn), cosine = std::cos(turn);
  c.right_from_left.rotation = {{cosine, 0, sine, 0, 1, 0, -sine, 0, cosine}};
  c.right_from_left.translation_mm = {-140 * cosine, 0, 140 * sine};
  return c;
}

class PoseExposure : public testing::Test {
 protected:
  PoseExposure() {
    auto made = LiveJudge::open(calibration());
    EXPECT_TRUE(made);
    judge.emplace(*std::move(made));
    pose.emplace(grabber, session, board, pool, &*judge);
    grab.emplace(grabber, session, board, *pose);
    EXPECT_TRUE(session.open("Ada"));
  }
  // Somebody poses for so many pictures; `at` says what happens with each.
  void pose_for(int pictures, const std::function<void(int)>& at = {}) {
    std::atomic<bool> cancelled{false};
    pipeline::Progress progress{};
    const int first = board.right_camera.pictures;
    board.right_camera.on_picture = [&, first] {
      const int here = board.right_camera.pictures - first;
      if (at) at(here);
      if (here >= pictures) cancelled = true;
    };
    JobControl control{cancelled, progress};
    const auto ended = pose->run(control);
    board.right_camera.on_picture = {};
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, Errc::Cancelled) << ended.error().what.view();
  }
  // How bright the brighter of both cameras now shows the brightest grains.
  double shown() const { return 0.6 * board.right_camera.lamp * 1.2 * static_cast<double>(board.right_camera.set.time.count()) * board.right_camera.set.gain / 10'000; }

  LitBoard board;
  BootMemory memory{std::size_t{14} * kWidth * kHeight, std::size_t{4} << 20, std::size_t{16} << 20};
  EnrolmentSession session{memory};
  StereoGrabber grabber{board};
  ThreadPool pool{1};
  std::optional<LiveJudge> judge;
  std::optional<PoseJob> pose;
  std::optional<GrabJob> grab;
};

TEST_F(PoseExposure, FindsOneExposureForBothAndFollowsTheLight) {
  pose_for(20);
  EXPECT_EQ(pose->exposure().state(), ExposureControl::State::Settled);
  EXPECT_EQ(board.left_camera.set.time, board.right_camera.set.time);
  EXPECT_EQ(board.left_camera.set.gain, board.right_camera.set.gain);
  EXPECT_NEAR(shown(), kBrightTarget, 1.5 * kLightTolerance * kBrightTarget);
  const auto before = board.left_camera.set;
  pose_for(20, [&](int) { board.left_camera.lamp = board.right_camera.lamp = 2; });
  EXPECT_LT(static_cast<double>(board.left_camera.set.time.count()) * board.left_camera.set.gain, 0.7 * static_cast<double>(before.time.count()) * before.gain);
  EXPECT_NEAR(shown(), kBrightTarget, 1.5 * kLightTolerance * kBrightTarget);
}

TEST_F(PoseExposure, TheBurstIsTakenAtTheExposureThatWasFound) {
  pose_for(20);
  const hal::Exposure found = board.left_camera.set;
  const int sets = board.left_camera.sets + board.right_camera.sets;
  board.left_camera.exposed.clear();
  board.right_camera.exposed.clear();
  board.right_camera.on_picture = [&] {
    EXPECT_EQ(pose->exposure().state(), ExposureControl::State::Locked);
    board.left_camera.lamp = board.right_camera.lamp = 0.3;  // somebody steps before the lamp
  };
  const std::atomic<bool> cancelled{false};
  pipeline::Progress progress{};
  JobControl control{cancelled, progress};
  const auto shot = grab->run(control);
  board.right_camera.on_picture = {};
  ASSERT_TRUE(shot) << shot.error().what.view();
  EXPECT_GE(board.left_camera.exposed.size(), static_cast<std::size_t>(budget::kBurstPairs));
  for (const LitCamera* camera : {&board.left_camera, &board.right_camera})
    for (const hal::Exposure& exposure : camera->exposed) EXPECT_TRUE(exposure.time == found.time && exposure.gain == found.gain);
  EXPECT_EQ(board.left_camera.sets + board.right_camera.sets, sets);
  EXPECT_EQ(pose->exposure().state(), ExposureControl::State::Settled);
  ASSERT_TRUE(session.products().frame);
}

}  // namespace
}  // namespace relievo::firmware
