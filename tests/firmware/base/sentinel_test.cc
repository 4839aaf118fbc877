// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/sentinel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>

#include "firmware/base/budget.h"
#include "firmware/command/commands.h"
#include "tests/firmware/kiosk/staff_hands.h"
#include "tests/support/manual_clock.h"
#include "ui/platform/sdl_display.h"

namespace relievo::firmware {
namespace {

TEST(Sentinel, TellsOfAHangOnceAndOfNoneWhileItIsKicked) {
  hal::ManualClock time;
  std::atomic<int> hangs{0};
  Sentinel sentinel(time, [&hangs] { ++hangs; });
  const auto looks_thrice = [] { std::this_thread::sleep_for(4 * budget::kTick); };
  time.advance(budget::kHangLimit);
  sentinel.kick();
  time.advance(budget::kHangLimit - std::chrono::milliseconds(1));
  looks_thrice();
  EXPECT_EQ(hangs, 0);
  time.advance(std::chrono::milliseconds(1));
  while (hangs == 0) looks_thrice();
  looks_thrice();
  EXPECT_EQ(hangs, 1) << "once";
  sentinel.kick();
  time.advance(budget::kHangLimit);
  while (hangs == 1) looks_thrice();
  EXPECT_EQ(hangs, 2) << "the next hang is another";
}

TEST(SentinelDeathTest, EndsTheProgramAndSaysWhy) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(Sentinel::end_program(), testing::KilledBySignal(SIGABRT), "the program hangs");
}

// Two frames. Whenever it is asked for its size, before the turn and before the drawing, much time has gone.
class SlowDisplay final : public ui::Display {
 public:
  SlowDisplay(std::unique_ptr<ui::Display> real, hal::ManualClock& time)
      : real_(std::move(real)), time_(time) {}
  int width_px() const override {
    time_.advance(budget::kHangLimit * 5 / 8);
    std::this_thread::sleep_for(4 * budget::kTick);  // the sentinel looks
    return real_->width_px();
  }
  int height_px() const override { return real_->height_px(); }
  std::optional<ui::Input> poll() override {
    return ++frames_ > 2 ? std::optional(ui::Input{ui::Input::Kind::Quit}) : std::nullopt;
  }
  void push(const ui::Input& finger) override { real_->push(finger); }
  Result<void> renew() override { return real_->renew(); }
  void show() override { real_->show(); }

 private:
  std::unique_ptr<ui::Display> real_;
  hal::ManualClock& time_;
  int frames_ = 0;
};

class MainLoopDeathTest : public StaffHands {};

TEST_F(MainLoopDeathTest, ATurnAndADrawingThatTakeLongOneByOneAreNoHang) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto run_slowly = [this] {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    hal::ManualClock time;
    Services slow{.console = console, .clock = time};
    slow.open_device = services.open_device;
    slow.open_store = services.open_store;
    slow.simulated_calibration = services.simulated_calibration;
    slow.open_display = [&time](const ui::DisplayOptions&) -> Result<std::unique_ptr<ui::Display>> {
      RELIEVO_TRY_ASSIGN(auto real, ui::open_sdl_display({640, 480}));
      return std::unique_ptr<ui::Display>(std::make_unique<SlowDisplay>(std::move(real), time));
    };
    return run(args, slow).has_value();
  };
  EXPECT_EXIT(std::_Exit(run_slowly() ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace relievo::firmware
