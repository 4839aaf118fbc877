// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/wire/gpio_trigger_line.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

#include "tests/hal/temporary_folder.h"
#include "tests/support/manual_clock.h"

namespace relievo::hal {
namespace {

using std::chrono::microseconds;

class PassingTime final : public Waiter {
 public:
  explicit PassingTime(ManualClock& clock) : clock_(clock) {}
  void until(Instant when) override {
    if (when > clock_.now()) clock_.advance(when - clock_.now());
  }

 private:
  ManualClock& clock_;
};

struct Change {
  long at_us;
  Wire wire;
  bool active;
  friend bool operator==(const Change&, const Change&) = default;
};

// What happened on the wires; the set that is due to fail, fails.
struct Record {
  std::vector<Change> changes;
  std::map<Wire, bool> now;
  int fail_at = -1;
};

class RecordedLines final : public OutputLines {
 public:
  RecordedLines(Record& record, const ManualClock& clock)
      : record_(record), clock_(clock), begin_(clock.now()) {}
  Result<void> set(Wire wire, bool active) override {
    if (record_.fail_at == 0) {
      record_.fail_at = -1;
      return Error{Errc::IoFailed, "the line does not answer"};
    }
    --record_.fail_at;
    const auto at = std::chrono::duration_cast<microseconds>(clock_.now() - begin_).count();
    if (record_.now[wire] != active) record_.changes.push_back({at, wire, active});
    record_.now[wire] = active;
    return {};
  }

 private:
  Record& record_;
  const ManualClock& clock_;
  Instant begin_;
};

struct Rig {
  ManualClock clock;
  PassingTime time{clock};
  Record record;
  GpioTriggerLine line;
  explicit Rig(const GpioTiming& timing)
      : line((clock.advance(std::chrono::seconds(5)), std::make_unique<RecordedLines>(record, clock)), timing,
             clock, time) {
    clock.advance(std::chrono::seconds(2));
  }
};
constexpr long kStart = 2'000'000;

TEST(GpioTriggerLine, PulsesForTheWidthAfterTheDelay) {
  Rig rig({microseconds(250), {}, {}, false});
  ASSERT_TRUE(rig.line.pulse(microseconds(100)));
  EXPECT_EQ(rig.record.changes,
            (std::vector<Change>{{kStart + 250, Wire::Trigger, true}, {kStart + 350, Wire::Trigger, false}}));
}

TEST(GpioTriggerLine, TheLampLeadsTheCamerasAndOutlastsThem) {
  Rig rig({{}, microseconds(200), microseconds(5000), false});
  ASSERT_TRUE(rig.line.pulse(microseconds(100), Light::Flash));
  EXPECT_EQ(rig.record.changes, (std::vector<Change>{{kStart, Wire::Lamp, true},
                                                     {kStart + 200, Wire::Trigger, true},
                                                     {kStart + 300, Wire::Trigger, false},
                                                     {kStart + 5000, Wire::Lamp, false}}));
}

TEST(GpioTriggerLine, TheLivePictureLightsNoLamp) {
  Rig rig({{}, microseconds(200), microseconds(5000), false});
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(rig.line.pulse(microseconds(100), Light::Off));
  for (const Change& change : rig.record.changes) ASSERT_EQ(change.wire, Wire::Trigger);
}

TEST(GpioTriggerLine, TheLampsLimitHoldsHereToo) {
  for (const bool one_wire : {false, true}) {
    Rig rig({{}, microseconds(200), microseconds(5000), one_wire});
    int taken = 0;
    for (int i = 0; i < 20; ++i)
      taken += rig.line.pulse(microseconds(100), one_wire ? Light::Off : Light::Flash) ? 1 : 0;
    EXPECT_EQ(taken, 3);
  }
}

TEST(GpioTriggerLine, WhateverFailsBothWiresAreInactiveAfterwards) {
  for (int fail_at = 0; fail_at < 4; ++fail_at) {
    Rig rig({{}, microseconds(200), microseconds(5000), false});
    rig.record.fail_at = fail_at;
    EXPECT_EQ(rig.line.pulse(microseconds(100), Light::Flash).error().code, Errc::IoFailed) << fail_at;
    EXPECT_FALSE(rig.record.now[Wire::Lamp]) << fail_at;
    EXPECT_FALSE(rig.record.now[Wire::Trigger]) << fail_at;
    EXPECT_TRUE(rig.line.pulse(microseconds(100), Light::Flash)) << "and the next one works";
  }
}

TEST(GpioTiming, TimesThatCannotBeAreRefused) {
  EXPECT_TRUE(GpioTiming{}.check());
  EXPECT_FALSE((GpioTiming{microseconds(-1), {}, {}, false}.check()));
  EXPECT_FALSE((GpioTiming{{}, microseconds(200'000), {}, false}.check()));
}

TEST(GpiodOutputLines, AChipThatIsNoneIsRefusedByName) {
  const TemporaryFolder folder;
  const std::string none = folder / "gpiochip0";
  for (const std::string& chip : {none, std::string("/dev/null")}) {
    const auto lines = request_gpiod_lines({chip, 3, {}, false});
    ASSERT_FALSE(lines) << chip;
    EXPECT_EQ(lines.error().code, Errc::NotFound) << lines.error().what.view();
    EXPECT_NE(lines.error().where().find(chip.substr(chip.size() - 5)), std::string_view::npos);
  }
}

TEST(BusyWaiter, DoesNotWakeBeforeItsTime) {
  const Instant until = std::chrono::steady_clock::now() + std::chrono::milliseconds(3);
  busy_waiter().until(until);
  EXPECT_GE(std::chrono::steady_clock::now(), until);
}

}  // namespace
}  // namespace relievo::hal
