// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sensor that adds up light as a real one does: the control has to find the exposure, both cameras the
// same.
#include "firmware/capture/face_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "firmware/base/budget.h"

namespace relievo::firmware {
namespace {

using std::chrono::microseconds;

constexpr hal::ExposureLimits kLimits{{microseconds(50), 1}, {microseconds(30'000), 16}};

// Skin reflects 0.2 to 0.6, its highlights 0.9; noise; saturates at white.
class LinearCamera final : public hal::Camera {
 public:
  explicit LinearCamera(double lamp) : lamp_(lamp), random_(3) {}
  hal::Exposure set;
  int sets = 0;
  std::optional<Errc> fails;
  hal::ExposureLimits limits = kLimits;
  void change_lamp(double lamp) { lamp_ = lamp; }

  FaceLight look() {
    std::vector<std::byte> pixels(64 * 64);
    std::normal_distribution<double> noise(0, 1.5);
    for (int i = 0; i < 64 * 64; ++i) {
      const double skin = i % 97 == 0 ? 0.9 : 0.2 + 0.4 * (i % 64) / 63.0;
      const double light = lamp_ * skin * static_cast<double>(set.time.count()) * set.gain / 1000;
      pixels[static_cast<std::size_t>(i)] =
          std::byte(static_cast<unsigned char>(std::clamp(255 * light + noise(random_), 0.0, 255.0)));
    }
    const ImageView view{pixels.data(), 64, 64, 64, PixelFormat::Grey8};
    return *face_light(view, {0, 0, 64, 64});
  }

 private:
  Result<void> do_open(const hal::CaptureMode&) override { return {}; }
  Result<void> do_start() override { return {}; }
  void do_stop() override {}
  Result<hal::Frame> do_next_frame(hal::Instant) override {
    return Error{Errc::Timeout, "this camera is only looked at"};
  }
  Result<void> do_set_exposure(const hal::Exposure& exposure) override {
    if (fails) return Error{*fails, "as the test says"};
    EXPECT_GE(exposure.time, limits.least.time);
    EXPECT_LE(exposure.time, limits.most.time);
    EXPECT_GE(exposure.gain, limits.least.gain);
    EXPECT_LE(exposure.gain, limits.most.gain);
    set = exposure;
    ++sets;
    return {};
  }
  Result<hal::ExposureLimits> do_exposure_limits() const override {
    if (fails) return Error{*fails, "as the test says"};
    return limits;
  }
  double lamp_;
  std::mt19937 random_;
};

struct Rig {
  LinearCamera left, right;
  ExposureControl control{left, right};
  explicit Rig(double lamp) : left(lamp), right(0.88 * lamp) { EXPECT_TRUE(left.open({}) && right.open({})); }
  int settle() {
    for (int i = 1; i <= 30; ++i) {
      EXPECT_TRUE(control.step(left.look(), right.look()));
      EXPECT_EQ(left.set, right.set) << "each pair is taken with one exposure";
      if (control.state() == ExposureControl::State::Settled) return i;
    }
    return 31;
  }
};

TEST(ExposureControl, FindsTheLightFromAnyStartWithinHalfASecond) {
  for (const double lamp : {0.05, 0.2, 1.0, 5.0, 20.0})
    for (const microseconds first : {microseconds(50), microseconds(1000), microseconds(8000)}) {
      Rig rig(lamp);
      ASSERT_TRUE(rig.control.begin({first, 1}));
      EXPECT_LE(rig.settle(), 8) << lamp << ' ' << first.count();  // pairs, at 15 a second
      const FaceLight light = rig.left.look();
      EXPECT_LE(light.bright, 1.1 * kBrightTarget);
      EXPECT_LE(light.clipped, 0.005) << "the highlights have burnt out";
      EXPECT_TRUE(light.bright >= 0.9 * kBrightTarget || light.highlight >= 0.9 * kHighlightTarget)
          << "darker than need be";
      EXPECT_LE(rig.control.exposure().time, budget::kLongestExposure);
    }
}

TEST(ExposureControl, TimeComesBeforeGain) {
  Rig bright(1.0);
  ASSERT_TRUE(bright.control.begin({microseconds(100), 8}));
  bright.settle();
  EXPECT_EQ(bright.control.exposure().gain, 1);
  Rig dim(0.05);
  ASSERT_TRUE(dim.control.begin({microseconds(100), 1}));
  dim.settle();
  EXPECT_EQ(dim.control.exposure().time, budget::kLongestExposure);
  EXPECT_GT(dim.control.exposure().gain, 1);
}

TEST(ExposureControl, TooDarkForAllItHasItSettlesAtItsMost) {
  Rig rig(0.0005);
  ASSERT_TRUE(rig.control.begin({microseconds(100), 1}));
  EXPECT_LE(rig.settle(), 12);
  EXPECT_EQ(rig.control.exposure(), (hal::Exposure{budget::kLongestExposure, 16}));
}

TEST(ExposureControl, ALockedExposureStaysWhateverTheLightDoes) {
  Rig rig(1.0);
  ASSERT_TRUE(rig.control.begin({microseconds(100), 1}));
  EXPECT_EQ(rig.control.lock().error().code, Errc::InvalidState) << "not before the light is known";
  rig.settle();
  ASSERT_TRUE(rig.control.lock());
  const int sets = rig.left.sets;
  rig.left.change_lamp(5);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(rig.control.step(rig.left.look(), rig.right.look()));
  EXPECT_EQ(rig.left.sets, sets);
  rig.control.unlock();
  rig.settle();
  EXPECT_GT(rig.left.sets, sets);
}

TEST(ExposureControl, CamerasThatCannotBeSetAreLeftAsTheyAre) {
  Rig rig(1.0);
  rig.right.fails = Errc::Unsupported;
  ASSERT_TRUE(rig.control.begin({microseconds(100), 1}));
  EXPECT_EQ(rig.control.state(), ExposureControl::State::Fixed);
  EXPECT_EQ(rig.left.sets, 0) << "one camera alone is not set either";
  EXPECT_TRUE(rig.control.step(rig.left.look(), rig.right.look()));
  EXPECT_TRUE(rig.control.lock());
}

TEST(ExposureControl, ACameraThatFailsIsTold) {
  Rig rig(1.0);
  ASSERT_TRUE(rig.control.begin({microseconds(100), 1}));
  rig.right.fails = Errc::Disconnected;
  EXPECT_EQ(rig.control.step(rig.left.look(), rig.right.look()).error().code, Errc::Disconnected);
  EXPECT_EQ(rig.control.lock().error().code, Errc::InvalidState);
}

TEST(ExposureControl, CamerasThatShareNoExposureAreRefused) {
  Rig rig(1.0);
  rig.right.limits = {{microseconds(40'000), 1}, {microseconds(90'000), 2}};
  EXPECT_EQ(rig.control.begin({microseconds(100), 1}).error().code, Errc::Unsupported);
}

}  // namespace
}  // namespace relievo::firmware
