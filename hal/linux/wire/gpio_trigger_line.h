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

#include <memory>

#include "hal/linux/wire/output_lines.h"
#include "hal/trigger_line.h"

namespace relievo::hal {

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
