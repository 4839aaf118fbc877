// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SilentTrigger: a trigger line without a wire. It counts pulses; cameras that hang on it expose
// once for every pulse since they last did.
// Thread: any.
#pragma once

#include <condition_variable>
#include <mutex>

#include "hal/clock.h"
#include "hal/trigger_line.h"

namespace relievo::hal {

class SilentTrigger final : public TriggerLine {
 public:
  explicit SilentTrigger(const Clock& clock) : TriggerLine(clock), clock_(clock) {}

  struct Pulse {
    std::uint32_t number = 0;  // counts from 1
    Instant at;
  };
  // The newest pulse after number `after`; waits for one until the deadline. Nothing: Timeout.
  Result<Pulse> wait_after(std::uint32_t after, Instant deadline);
  std::uint32_t count() const;

 private:
  Result<void> do_pulse(std::chrono::microseconds width, Light light) override;

  const Clock& clock_;
  mutable std::mutex mutex_;
  std::condition_variable pulsed_;
  Pulse last_;
};

}  // namespace relievo::hal
