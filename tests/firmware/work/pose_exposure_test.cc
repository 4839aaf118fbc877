// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// While somebody poses, both cameras are set to one exposure by the light they see; for the burst nobody
// changes it. The scene is one in which no face is found: metered is the middle.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <vector>

#include "firmware/work/jobs.h"
#include "hal/clock.h"
#include "tests/firmware/work/lit_device.h"

namespace relievo::firmware {
namespace {

constexpr int kGrainsWidth = 160, kGrainsHeight = 120;

// Dark at the sides, where nobody stands; in the middle grains of 0.25 to 0.6.
std::vector<double> grains() {
  std::vector<double> light(std::size_t{kGrainsWidth} * kGrainsHeight, 0.01);
  for (int y = 0; y < kGrainsHeight; ++y)
    for (int x = 0; x < kGrainsWidth; ++x)
      if (std::abs(x - kGrainsWidth / 2) < kGrainsWidth / 4)
        light[static_cast<std::size_t>(y * kGrainsWidth + x)] = 0.25 + 0.35 * ((x * 7 + y * 13) % 16) / 15.0;
  return light;
}

pipeline::StereoCalibration calibration() {
  pipeline::StereoCalibration c;
  c.left = c.right = {{245, 245}, {kGrainsWidth / 2.0, kGrainsHeight / 2.0}, {}, kGrainsWidth, kGrainsHeight};
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
    pose.emplace(grabber, session, device, pool, &*judge);
    grab.emplace(grabber, session, device, *pose);
    EXPECT_TRUE(session.open("Ada"));
  }
  // Somebody poses for so many pictures; `at` says what happens with each.
  void pose_for(int pictures, const std::function<void(int)>& at = {}) {
    std::atomic<bool> cancelled{false};
    pipeline::Progress progress{};
    const int first = device.right_camera.pictures;
    device.right_camera.on_picture = [&, first] {
      const int here = device.right_camera.pictures - first;
      if (at) at(here);
      if (here >= pictures) cancelled = true;
    };
    JobControl control{cancelled, progress};
    const auto ended = pose->run(control);
    device.right_camera.on_picture = {};
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().code, Errc::Cancelled) << ended.error().what.view();
  }
  // How bright the brighter of both cameras now shows the brightest grains.
  double shown() const { return 0.6 * device.right_camera.factor(); }

  test::LitDevice device{{grains(), grains(), kGrainsWidth}};
  BootMemory memory{std::size_t{14} * kGrainsWidth * kGrainsHeight, std::size_t{4} << 20,
                    std::size_t{16} << 20};
  EnrolmentSession session{memory};
  StereoGrabber grabber{device};
  ThreadPool pool{1};
  std::optional<LiveJudge> judge;
  std::optional<PoseJob> pose;
  std::optional<GrabJob> grab;
};

TEST_F(PoseExposure, FindsOneExposureForBothAndFollowsTheLight) {
  pose_for(20);
  EXPECT_EQ(pose->exposure().state(), ExposureControl::State::Settled);
  EXPECT_EQ(device.left_camera.set.time, device.right_camera.set.time);
  EXPECT_EQ(device.left_camera.set.gain, device.right_camera.set.gain);
  EXPECT_NEAR(shown(), kBrightTarget, 1.5 * kLightTolerance * kBrightTarget);
  const auto before = device.left_camera.set;
  pose_for(20, [&](int) { device.left_camera.lamp = device.right_camera.lamp = 2; });
  EXPECT_LT(static_cast<double>(device.left_camera.set.time.count()) * device.left_camera.set.gain,
            0.7 * static_cast<double>(before.time.count()) * before.gain);
  EXPECT_NEAR(shown(), kBrightTarget, 1.5 * kLightTolerance * kBrightTarget);
}

TEST_F(PoseExposure, TheBurstIsTakenAtTheExposureThatWasFound) {
  pose_for(20);
  const hal::Exposure found = device.left_camera.set;
  const int sets = device.left_camera.sets + device.right_camera.sets;
  device.left_camera.exposed.clear();
  device.right_camera.exposed.clear();
  device.right_camera.on_picture = [&] {
    EXPECT_EQ(pose->exposure().state(), ExposureControl::State::Locked);
    device.left_camera.lamp = device.right_camera.lamp = 0.3;  // somebody steps before the lamp
  };
  const std::atomic<bool> cancelled{false};
  pipeline::Progress progress{};
  JobControl control{cancelled, progress};
  const auto shot = grab->run(control);
  device.right_camera.on_picture = {};
  ASSERT_TRUE(shot) << shot.error().what.view();
  EXPECT_GE(device.left_camera.exposed.size(), static_cast<std::size_t>(budget::kBurstPairs));
  for (const test::LitCamera* camera : {&device.left_camera, &device.right_camera})
    for (const hal::Exposure& exposure : camera->exposed)
      EXPECT_TRUE(exposure.time == found.time && exposure.gain == found.gain);
  EXPECT_EQ(device.left_camera.sets + device.right_camera.sets, sets);
  EXPECT_EQ(pose->exposure().state(), ExposureControl::State::Settled);
  ASSERT_TRUE(session.products().frame);
}

}  // namespace
}  // namespace relievo::firmware
