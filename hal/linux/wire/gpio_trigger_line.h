// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GpioTriggerLine: pulses two wires:
//
//   lamp     ____|‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾‾|____     lit `lamp_lead` before the cameras, for `lamp_time`
//   trigger  ________|‾‾‾‾‾‾‾|____________     `delay` after the call at the least, for `width`
//
// Waits by the machine's clock, the last 100 microseconds without sleeping, since a thread wakes late.
// Errors: as hal/trigger_line.h; IoFailed or Disconnected from the lines, which are then set inactive.
// Thread: any; pulses wait for one another.
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hal/base/result.h"
#include "hal/trigger_line.h"

namespace relievo::hal {

// LastWill: a process of its own that does one thing when this one ends, however it ends: by itself, by
// a crash, killed. It waits at a pipe whose writing end only this process has.
// Errors: IoFailed (no pipe, no process). Thread: main, before others are made, since it forks.
class LastWill {
 public:
  // `will` runs in the child, which shares what is open now: system calls only, nothing that locks.
  static Result<LastWill> make(const std::function<void()>& will);
  // Has it done, and waits until it is.
  ~LastWill();
  LastWill(LastWill&& other) noexcept
      : child_(std::exchange(other.child_, 0)), alive_(std::exchange(other.alive_, -1)) {}
  LastWill& operator=(LastWill&&) = delete;

 private:
  LastWill(pid_t child, int alive) : child_(child), alive_(alive) {}
  pid_t child_;
  int alive_;
};

// OutputLines: the wires of a GPIO chip that this process drives: the trigger's, and perhaps the lamp's.
// Inactive from the request on, and inactive when the object ends. The seam under GpioTriggerLine.
// Thread: one at a time.
enum class Wire : std::uint8_t { Trigger, Lamp };

class OutputLines {
 public:
  virtual ~OutputLines() = default;
  virtual Result<void> set(Wire wire, bool active) = 0;  // IoFailed, Disconnected
};

struct GpioOptions {
  std::string chip;              // /dev/gpiochip0
  unsigned trigger = 0;          // the line's offset on the chip
  std::optional<unsigned> lamp;  // none: no lamp, or one on the trigger's wire
  bool active_low = false;       // both
};

// Through libgpiod, 1.6 or 2 as the library at build time is. A process of its own waits beside: when
// this one dies, killed in the middle of a pulse even, it drives the lines inactive before the kernel
// gives them free.
// Errors: NotFound (no such chip or line), IoFailed (not allowed, in use, not an output).
Result<std::unique_ptr<OutputLines>> request_gpiod_lines(const GpioOptions& options);

struct GpioTiming {
  std::chrono::microseconds delay{0};
  std::chrono::microseconds lamp_lead{0};
  std::chrono::microseconds lamp_time{0};  // 0: as long as the lead and the trigger's pulse together
  bool lamp_on_trigger_wire = false;       // every pulse is a flash
  // InvalidInput: negative, or longer than TriggerLine::kLongestPulse.
  Result<void> check() const;
};

// How a thread waits; tests let time pass at once.
class Waiter {
 public:
  virtual ~Waiter() = default;
  virtual void until(Instant when) = 0;
};
Waiter& busy_waiter();

class GpioTriggerLine final : public TriggerLine {
 public:
  GpioTriggerLine(std::unique_ptr<OutputLines> lines, const GpioTiming& timing, const Clock& clock,
                  Waiter& waiter = busy_waiter())
      : TriggerLine(clock), lines_(std::move(lines)), timing_(timing), waiter_(waiter) {}

  bool lights_with_every_pulse() const override { return timing_.lamp_on_trigger_wire; }

 private:
  Result<void> do_pulse(std::chrono::microseconds width, Light light) override;
  Result<void> drive(std::chrono::microseconds width, bool lit);
  void rest();

  std::unique_ptr<OutputLines> lines_;
  GpioTiming timing_;
  Waiter& waiter_;
};

}  // namespace relievo::hal
