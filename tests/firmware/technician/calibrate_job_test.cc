// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Who reads the newest pair of a live calibration while the next one is being drawn sees left and right of
// one instant.
#include "firmware/technician/calibration_controller.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "hal/sim/device.h"
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

}  // namespace
}  // namespace relievo::firmware
