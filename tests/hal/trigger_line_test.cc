// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lamp may not harm anybody, however it is asked: every schedule is judged by counting, at the lamp
// itself, the flashes that any window of one second touches.
#include "hal/trigger_line.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <vector>

#include "hal/clock.h"
#include "tests/support/manual_clock.h"

namespace relievo::hal {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr microseconds kPulse{100};

// Notes from when to when its lamp was lit.
class LampLine final : public TriggerLine {
 public:
  struct Flash {
    Instant begin, end;
  };
  explicit LampLine(ManualClock& clock, bool one_wire = false)
      : TriggerLine(clock), clock_(clock), one_wire_(one_wire) {}
  std::vector<Flash> flashes;
  int pulses = 0;
  bool broken = false;
  std::chrono::nanoseconds sluggish{0};  // the driver takes this long before and after
  bool lights_with_every_pulse() const override { return one_wire_; }

 private:
  Result<void> do_pulse(microseconds width, Light light) override {
    ++pulses;
    clock_.advance(sluggish);
    if (light == Light::Flash || one_wire_) flashes.push_back({clock_.now(), clock_.now() + width});
    clock_.advance(width + sluggish);
    if (broken) return Error{Errc::IoFailed, "the line broke while it was lit"};
    return {};
  }
  ManualClock& clock_;
  bool one_wire_;
};

// The most flashes that one closed second touches; obvious and slow.
std::size_t most_in_a_second(const std::vector<LampLine::Flash>& flashes) {
  std::size_t most = 0;
  for (const auto& first : flashes) {
    std::size_t touched = 0;
    for (const auto& other : flashes)
      if (other.begin >= first.begin && other.begin <= first.end + seconds(1)) ++touched;
    most = std::max(most, touched);
  }
  return most;
}

class TriggerLineTest : public testing::Test {
 protected:
  ManualClock clock;
  LampLine line{clock};
};

TEST_F(TriggerLineTest, AThirdFlashIsAllowedAndAFourthIsNot) {
  clock.advance(seconds(2));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(line.pulse(kPulse, Light::Flash));
  const auto refused = line.pulse(kPulse, Light::Flash);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Timeout);
  EXPECT_EQ(line.pulses, 3) << "a refused pulse drives nothing";
  clock.advance(line.flash_allowed_at() - clock.now() - std::chrono::nanoseconds(1));
  EXPECT_FALSE(line.pulse(kPulse, Light::Flash));
  clock.advance(std::chrono::nanoseconds(1));
  EXPECT_TRUE(line.pulse(kPulse, Light::Flash));
}

TEST_F(TriggerLineTest, WithoutLightThereIsNoLimit) {
  for (int i = 0; i < 500; ++i) ASSERT_TRUE(line.pulse(kPulse));
  EXPECT_EQ(line.pulses, 500);
  EXPECT_TRUE(line.flashes.empty()) << "the live picture never flashes";
}

TEST_F(TriggerLineTest, WidthsThatCannotBeAreRefused) {
  for (const microseconds width :
       {microseconds(0), microseconds(-1), TriggerLine::kLongestPulse + microseconds(1)})
    EXPECT_EQ(line.pulse(width, Light::Off).error().code, Errc::InvalidInput);
  EXPECT_EQ(line.pulses, 0);
}

TEST_F(TriggerLineTest, TheFirstSecondIsDarkSoThatRestartsDoNotFlashMore) {
  std::vector<LampLine::Flash> all;
  for (int restart = 0; restart < 40; ++restart) {
    LampLine again(clock);
    for (int i = 0; i < 10; ++i) {
      (void)again.pulse(kPulse, Light::Flash).has_value();
      clock.advance(milliseconds(restart));
    }
    all.insert(all.end(), again.flashes.begin(), again.flashes.end());
  }
  EXPECT_LE(most_in_a_second(all), 3U);
}

TEST_F(TriggerLineTest, AFlashThatFailedCounts) {
  clock.advance(seconds(2));
  line.broken = true;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(line.pulse(kPulse, Light::Flash).error().code, Errc::IoFailed);
  EXPECT_EQ(line.pulse(kPulse, Light::Flash).error().code, Errc::Timeout);
}

TEST(TriggerLine, ALampOnTheTriggersOwnWireCountsWithEveryPulse) {
  ManualClock clock;
  LampLine line(clock, true);
  clock.advance(seconds(2));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(line.pulse(kPulse, Light::Off));
  EXPECT_EQ(line.pulse(kPulse, Light::Off).error().code, Errc::Timeout);
}

// Schedules made to slip through: bursts as fast as it goes, just at the limit, with long flashes, a slow
// driver, a broken one, and all of that mixed.
TEST(TriggerLine, NoScheduleFlashesMoreThanThreeTimesInAnySecond) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    ManualClock clock;
    LampLine line(clock, seed % 5 == 0);
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
      line.broken = random() % 7 == 0;
      line.sluggish = microseconds(random() % 2 == 0 ? 0 : random() % 30'000);
      const microseconds width(1 + random() % 100'000);
      switch (random() % 4) {
        case 0: clock.advance(microseconds(random() % 2000)); break;
        case 1: clock.advance(milliseconds(random() % 400)); break;
        case 2:
          clock.advance(std::max(std::chrono::nanoseconds(0), line.flash_allowed_at() - clock.now()));
          break;
        default: break;
      }
      const auto done = line.pulse(width, random() % 8 == 0 ? Light::Off : Light::Flash);
      if (!done && done.error().code == Errc::Timeout) ++refused;
    }
    EXPECT_LE(most_in_a_second(line.flashes), 3U) << "seed " << seed;
    EXPECT_GT(refused, 50) << "the schedule asked for too little";
    EXPECT_GT(line.flashes.size(), 50U);
  }
}

// Two threads that do not know of one another, on the machine's clock.
TEST(TriggerLine, TwoCallersShareOneLimit) {
  class CountingLine final : public TriggerLine {
   public:
    using TriggerLine::TriggerLine;
    int flashes = 0;

   private:
    Result<void> do_pulse(microseconds, Light) override {
      ++flashes;
      return {};
    }
  };
  const MonotonicClock clock;
  CountingLine line(clock);
  std::this_thread::sleep_until(line.flash_allowed_at());
  const Instant begin = clock.now();
  const auto hammer = [&] {
    for (int i = 0; i < 2000; ++i) (void)line.pulse(kPulse, Light::Flash).has_value();
  };
  std::thread other(hammer);
  hammer();
  other.join();
  const auto windows = (clock.now() - begin) / FlashGuard::kWindow + 1;
  EXPECT_LE(line.flashes, 3 * windows);
  EXPECT_GE(line.flashes, 3);
}

}  // namespace
}  // namespace relievo::hal
