// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who reads the newest pair of a live calibration while the next one is being drawn sees left and right of
// one instant. Nothing that happens to the cameras takes the views that they have given.
#include "firmware/technician/technician_jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

#include "hal/sim/device.h"
#include "tests/firmware/held_hand.h"
#include "tests/firmware/technician/spoiled_pairs.h"
#include "tests/support/played_device.h"
#include "tests/support/small_device.h"

namespace relievo::firmware {
namespace {

constexpr int kWidth = 640, kHeight = 480, kPairs = 30;

// Grey pairs without a board, each another grey, the same left and right.
class GreyPairs final : public LivePairs {
 public:
  Result<std::optional<LivePair>> next(const pipeline::LiveState&) override {
    if (count_ == kPairs) return std::optional<LivePair>();
    ++count_;
    bytes_.assign(std::size_t{kWidth} * kHeight, static_cast<std::byte>(count_));
    const ImageView view{bytes_.data(), kWidth, kHeight, kWidth, PixelFormat::Grey8};
    return std::optional<LivePair>({view, view, std::chrono::milliseconds(100 * count_)});
  }

 private:
  int count_ = 0;
  std::vector<std::byte> bytes_;
};

TEST(CalibrateJob, LeftAndRightAreOfTheSameInstantWheneverTheyAreRead) {
  auto device = *hal::make_sim_device(test::small_device(1));
  const BootMemory memory;
  EnrolmentSession session(memory);
  StereoGrabber grabber(*device);
  ThreadPool pool(1);
  CalibrateJob job(grabber, session, *device, pool,
                   [](const BoardArgs&) -> Result<std::unique_ptr<LivePairs>> {
                     return std::unique_ptr<LivePairs>(std::make_unique<GreyPairs>());
                   });
  job.order({{10, 7, 20}, std::nullopt});
  std::atomic<bool> over{false};
  const std::atomic<bool> cancelled{false};
  std::thread worker([&] {
    pipeline::Progress progress;
    JobControl control{cancelled, progress};
    EXPECT_FALSE(job.run(control)) << "no board was shown";
    over = true;
  });
  int seen = 0, apart = 0;
  std::uint32_t last = 0;
  while (!over) {
    const ui::TechnicianCalibration now = job.newest();
    if (now.pictures[0].pixels.empty() || now.pictures[0].version == last) continue;
    last = now.pictures[0].version;
    ++seen;
    const bool right = !now.pictures[1].pixels.empty();
    if (!right || now.pictures[0].pixels.row(100)[300] != now.pictures[1].pixels.row(100)[300]) ++apart;
  }
  worker.join();
  EXPECT_GT(seen, 5);
  EXPECT_EQ(apart, 0) << "of " << seen;
}

constexpr int kEnoughViews = 7;

// On a board in a hand.
class CalibrateJobTest : public testing::Test {
 protected:
  Result<void> run() {
    job.order({{10, 7, 20}, std::nullopt});
    const std::atomic<bool> cancelled{false};
    pipeline::Progress progress;
    JobControl control{cancelled, progress};
    return job.run(control);
  }

  test::PlayedWorld world;  // its clock
  test::PlayedDevice device{world, kWidth, kHeight};
  const BootMemory memory;
  EnrolmentSession session{memory};
  StereoGrabber grabber{device};
  ThreadPool pool{2};
  SpoiledPairs::Spoils spoils;
  CalibrateJob job{grabber, session, device, pool,
                   [this](const BoardArgs& args) -> Result<std::unique_ptr<LivePairs>> {
                     return std::unique_ptr<LivePairs>(std::make_unique<SpoiledPairs>(
                         make_hand_pairs(held_board(test::small_rig(0.25), args), 1), spoils));
                   }};
};

TEST_F(CalibrateJobTest, APairThatDoesNotComeTakesNothingOfWhatWasSeenAndIsTold) {
  std::vector<Errc> to_come{Errc::IoFailed, Errc::Disconnected, Errc::Timeout};
  std::optional<Errc> told;
  spoils = [&](const pipeline::LiveState& state) -> Result<bool> {
    const ui::Fault problem = job.newest().problem;
    EXPECT_EQ(problem.empty(), !told);
    if (told) {
      EXPECT_EQ(problem.code, *told);
    }
    told.reset();
    if (state.views >= kEnoughViews) job.finish();
    if (state.views != 3 || to_come.empty()) return false;
    told = to_come.back();
    to_come.pop_back();
    return Error{*told, "as the test says"};
  };
  EXPECT_TRUE(run());
  EXPECT_TRUE(to_come.empty());
  ASSERT_TRUE(job.result());
  EXPECT_GE(job.result()->quality.used, kEnoughViews - 1);
  EXPECT_TRUE(job.newest().problem.empty());
}

TEST_F(CalibrateJobTest, WhatWasSeenBeforeTheCamerasWentForGoodIsJudged) {
  int tries = 0;
  spoils = [&](const pipeline::LiveState& state) -> Result<bool> {
    if (state.views < kEnoughViews) return false;
    ++tries;
    world.ahead_s += 3600;
    return Error{Errc::Disconnected, "as the test says"};
  };
  EXPECT_TRUE(run());
  EXPECT_TRUE(job.result());
  EXPECT_EQ(tries, 2) << "once more, and then it was too long";
  EXPECT_EQ(job.newest().problem.code, Errc::Disconnected);
}

TEST_F(CalibrateJobTest, WhatWasSeenBeforePicturesOfAnotherSizeIsJudged) {
  spoils = [](const pipeline::LiveState& state) -> Result<bool> { return state.views >= kEnoughViews; };
  EXPECT_TRUE(run());
  EXPECT_TRUE(job.result());
  EXPECT_EQ(job.newest().problem.code, Errc::InvalidInput);
}

TEST_F(CalibrateJobTest, WhereNothingWasSeenTheReasonIsTold) {
  spoils = [](const pipeline::LiveState&) -> Result<bool> {
    return Error{Errc::LibraryFailed, "as the test says"};
  };
  const Result<void> done = run();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::LibraryFailed);
  EXPECT_FALSE(job.result());
}

TEST(CalibrateJob, CamerasThatWereAwayComeBackAndOthersInTheirPlacesEndIt) {
  test::PlayedWorld world;
  world.pulled = true;
  test::PlayedDevice device(world, kWidth, kHeight);
  device.left_camera.number = "L", device.right_camera.number = "R";
  const BootMemory memory;
  EnrolmentSession session(memory);
  StereoGrabber grabber(device);
  ThreadPool pool(1);
  CalibrateJob job(grabber, session, device, pool, {});
  job.order({{10, 7, 20}, std::nullopt});
  std::atomic<bool> over{false};
  const std::atomic<bool> cancelled{false};
  std::thread worker([&] {
    pipeline::Progress progress;
    JobControl control{cancelled, progress};
    (void)job.run(control);
    over = true;
  });
  // Minutes are "never".
  const auto until = [](const auto& condition) {
    for (int i = 0; i < 12'000 && !condition(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return condition();
  };
  const auto troubled = [&] { return !job.newest().problem.empty(); };
  // From the beginning, and later.
  EXPECT_TRUE(until(troubled));
  EXPECT_FALSE(over);
  world.pulled = false;
  EXPECT_TRUE(until([&] { return !job.newest().pictures[0].pixels.empty(); }));
  world.pulled = true;
  EXPECT_TRUE(until(troubled));
  world.pulled = false;
  EXPECT_TRUE(until([&] { return !troubled(); })) << "pairs come again";
  EXPECT_FALSE(over);
  world.pulled = true;
  EXPECT_TRUE(until(troubled));
  device.left_camera.number = "X";
  world.pulled = false;
  EXPECT_TRUE(until([&] { return over.load(); }));
  job.finish();
  worker.join();
  ASSERT_FALSE(job.outcome());
  EXPECT_EQ(job.outcome().error().code, Errc::NotCalibrated);
}

}  // namespace
}  // namespace relievo::firmware
