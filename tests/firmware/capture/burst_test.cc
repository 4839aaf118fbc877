// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bursts of a face that moves, blurs, fails to come: which pair is kept, and how the lamp is spared.
#include "firmware/capture/stereo_grabber.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "firmware/base/boot_memory.h"
#include "firmware/session/session.h"
#include "firmware/work/jobs.h"
#include "tests/firmware/capture/scripted_rig.h"
#include "tests/support/allocation_counter.h"

namespace relievo::firmware {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr int kBarsSide = 128;
constexpr hal::CaptureMode kBarsMode{kBarsSide, kBarsSide, microseconds(100)};

struct Look {
  double blur_px = 1;
  double shift_px = 0;
  std::optional<Errc> error;
};

// Shows upright bars, blurred and shifted as its looks say, one a pulse.
class BarsCamera final : public hal::Camera {
 public:
  explicit BarsCamera(HandClock& clock) : clock_(clock) {}
  std::deque<Look> looks;
  void pulse() { at_ = clock_.now() + microseconds(10), waiting_ = true; }

 private:
  Result<void> do_open(const hal::CaptureMode&) override { return {}; }
  Result<void> do_start() override { return {}; }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant deadline) override {
    const Look look = looks.empty() ? Look{} : looks.front();
    if (!looks.empty()) looks.pop_front();
    if (look.error || !waiting_) {
      clock_.time = std::max(clock_.time, deadline);
      return Error{look.error.value_or(Errc::Timeout), "as the test says"};
    }
    waiting_ = false;
    for (int y = 0; y < kBarsSide; ++y)
      for (int x = 0; x < kBarsSide; ++x) {
        const double wave = std::sin(2 * M_PI * (x + look.shift_px) / 24) * 24 / (2 * M_PI);
        pixels_[static_cast<std::size_t>(y * kBarsSide + x)] =
            std::byte(static_cast<unsigned char>(std::lround(120 + 60 * std::tanh(wave / look.blur_px))));
      }
    return hal::Frame(
        hal::raw_of({pixels_.data(), kBarsSide, kBarsSide, kBarsSide, PixelFormat::Grey8}),
        {at_, ++sequence_}, [](void*, int) {}, this, 0);
  }
  HandClock& clock_;
  std::vector<std::byte> pixels_ = std::vector<std::byte>(std::size_t{kBarsSide} * kBarsSide);
  hal::Instant at_;
  bool waiting_ = false;
  std::uint32_t sequence_ = 0;
};

class BarsLine final : public hal::TriggerLine {
 public:
  BarsLine(HandClock& clock, BarsCamera& left, BarsCamera& right)
      : TriggerLine(clock), clock_(clock), left_(left), right_(right) {}
  std::vector<hal::Instant> flashes;
  int pulses = 0;

 private:
  Result<void> do_pulse(microseconds, hal::Light light) override {
    ++pulses;
    if (light == hal::Light::Flash) flashes.push_back(clock_.now());
    left_.pulse();
    right_.pulse();
    clock_.time += milliseconds(15);
    return {};
  }
  HandClock& clock_;
  BarsCamera& left_;
  BarsCamera& right_;
};

class BurstTest : public testing::Test {
 public:
  void SetUp() override { ASSERT_TRUE(grabber.start(kBarsMode)); }
  void show(const std::vector<Look>& looks) {
    for (BarsCamera* camera : {&left, &right}) camera->looks.assign(looks.begin(), looks.end());
  }
  Result<BurstResult> shoot(const BurstOptions& options = {}) {
    return take_burst(grabber, first, second, options, cancelled);
  }

  HandClock clock;
  BarsCamera left{clock}, right{clock};
  BarsLine line{clock, left, right};
  StereoGrabber grabber{
      left, right, line, clock, {.wait = [this](hal::Instant until, const std::atomic<bool>&) {
        clock.time = std::max(clock.time, until);
      }}};
  std::vector<std::byte> memory = std::vector<std::byte>(std::size_t{2} * 7 * kBarsSide * kBarsSide);
  StereoSlot first{std::span(memory).first(memory.size() / 2)};
  StereoSlot second{std::span(memory).subspan(memory.size() / 2)};
  std::atomic<bool> cancelled{false};
};

TEST_F(BurstTest, TheSharpestOfFiveIsKeptWhereverItComes) {
  for (int sharp = 0; sharp < 5; ++sharp) {
    std::vector<Look> looks(5, Look{3, 0, {}});
    looks[static_cast<std::size_t>(sharp)].blur_px = 1;
    show(looks);
    const int pulses = line.pulses;
    const auto result = shoot();
    ASSERT_TRUE(result) << result.error().what.view();
    EXPECT_EQ(line.pulses, pulses + 5);
    EXPECT_EQ(result->best, sharp);
    // The picture itself, not only its number: the sharp one's edge is steep.
    const std::uint8_t* row = result->frame.left.row(64);
    EXPECT_GT(std::abs(row[48 + 1] - row[48 - 1]), 60);
    EXPECT_GT(std::abs(result->frame.right.row(64)[48 + 1] - result->frame.right.row(64)[48 - 1]), 60);
  }
}

TEST_F(BurstTest, OfEquallySharpPairsTheStillestIsKept) {
  show({{1, 0, {}}, {1, 6, {}}, {1, 12, {}}, {1, 12.2, {}}, {1, 18, {}}});
  const auto result = shoot();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->best, 3);
  EXPECT_GT(result->pairs[1].movement, 10 * result->pairs[3].movement);
  EXPECT_EQ(result->pairs[0].movement, result->pairs[1].movement) << "the first has none before it";
}

TEST_F(BurstTest, TheWorseViewCounts) {
  show(std::vector<Look>(2, Look{1, 0, {}}));
  right.looks[0].blur_px = 4;
  BurstOptions two;
  two.pairs = 2;
  EXPECT_EQ(shoot(two)->best, 1);
}

TEST_F(BurstTest, APairThatFailsIsPassedOver) {
  const Look lost{1, 0, Errc::IoFailed};
  show({lost, lost, lost, {1, 0, {}}, {3, 0, {}}, {3, 0, {}}, {3, 0, {}}});
  right.looks = {{1, 0, {}}, {3, 0, {}}, {3, 0, {}}, {3, 0, {}}};
  const auto result = shoot();
  ASSERT_TRUE(result) << result.error().what.view();
  EXPECT_EQ(result->pairs[0].sharpness, 0);
  EXPECT_EQ(result->best, 1);
}

TEST_F(BurstTest, WithoutAnyPairTheReasonIsTold) {
  show(std::vector<Look>(100, Look{1, 0, Errc::IoFailed}));
  EXPECT_EQ(shoot().error().code, Errc::IoFailed);
}

TEST_F(BurstTest, ACameraThatVanishesLeavesWhatWasTaken) {
  show({{1, 0, {}}, {1, 0, Errc::Disconnected}});
  const auto result = shoot();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->best, 0);
  EXPECT_EQ(grabber.watch(), CameraWatch::LeftGone);
  EXPECT_EQ(shoot().error().code, Errc::Disconnected) << "and before the first pair it is an error";
}

TEST_F(BurstTest, CancelEndsIt) {
  cancelled = true;
  EXPECT_EQ(shoot().error().code, Errc::Cancelled);
  EXPECT_LE(line.pulses, 1);
}

TEST_F(BurstTest, TheLampRestsBetweenFlashes) {
  BurstOptions lit;
  lit.light = hal::Light::Flash;
  lit.pairs = 16;
  const auto result = shoot(lit);
  ASSERT_TRUE(result) << result.error().what.view();
  ASSERT_EQ(line.flashes.size(), 16U);
  for (std::size_t i = 3; i < line.flashes.size(); ++i)
    EXPECT_GT(line.flashes[i] - line.flashes[i - 3], std::chrono::seconds(1));
}

TEST_F(BurstTest, AllocatesNothing) {
  ASSERT_TRUE(shoot());
  const AllocationCounter counter;
  const auto result = shoot();
  EXPECT_EQ(counter.made(), 0);
  EXPECT_TRUE(result);
}

// What the appliance does: the best pair into the session, every one of them wiped with it.
TEST_F(BurstTest, TheJobKeepsTheBestPairAndTheSessionWipesAll) {
  class LiveDevice final : public hal::Device, hal::RemovableMedia, hal::Watchdog {
   public:
    explicit LiveDevice(BurstTest& test) : test_(test) {}
    std::string_view name() const override { return "test"; }
    hal::CaptureMode preferred_mode() const override { return kBarsMode; }
    hal::Camera& left() override { return test_.left; }
    hal::Camera& right() override { return test_.right; }
    hal::TriggerLine& trigger() override { return test_.line; }
    hal::RemovableMedia& media() override { return *this; }
    hal::Clock& clock() override { return test_.clock; }
    hal::Watchdog& watchdog() override { return *this; }

   private:
    std::optional<std::filesystem::path> current() override { return std::nullopt; }
    Result<void> flush_and_eject() override { return {}; }
    void kick() override {}
    BurstTest& test_;
  } device(*this);
  const BootMemory boot(std::size_t{2} * 7 * kBarsSide * kBarsSide, 1 << 16, 1 << 16);
  std::fill(boot.frames().begin(), boot.frames().end(), std::byte{0});
  EnrolmentSession session(boot);
  ASSERT_TRUE(session.open("Ada"));
  show({{3, 0, {}}, {3, 0, {}}, {1, 0, {}}, {3, 0, {}}, {3, 0, {}}});
  ThreadPool pool(1);
  PoseJob pose(grabber, session, device, pool, nullptr);
  GrabJob job(grabber, session, device, pose);
  pipeline::Progress progress;
  JobControl control{cancelled, progress};
  ASSERT_TRUE(job.run(control));
  EXPECT_EQ(line.pulses, 5);
  ASSERT_TRUE(session.products().frame);
  EXPECT_EQ(session.products().frame->sequence, 3U);
  EXPECT_TRUE(line.flashes.empty()) << "a board without a lamp flashes none";
  session.close();
  for (const std::byte b : boot.frames()) ASSERT_EQ(b, std::byte{0});
}

TEST_F(BurstTest, NonsenseIsRefused) {
  for (const int pairs : {0, -1, kMostBurstPairs + 1}) {
    BurstOptions options;
    options.pairs = pairs;
    EXPECT_EQ(shoot(options).error().code, Errc::InvalidInput);
  }
  BurstOptions outside;
  outside.face = FaceBox{500, 500, 40, 40};
  EXPECT_EQ(shoot(outside).error().code, Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo::firmware
