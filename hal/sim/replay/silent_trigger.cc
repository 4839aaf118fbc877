// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/sim/replay/silent_trigger.h"

namespace relievo::hal {

Result<void> SilentTrigger::do_pulse(std::chrono::microseconds, Light) {
  {
    const std::lock_guard lock(mutex_);
    last_ = {last_.number + 1, clock_.now()};
  }
  pulsed_.notify_all();
  return {};
}

// Polls the given clock rather than waiting on the machine's: with a ManualClock the deadline comes
// when the test says so.
Result<SilentTrigger::Pulse> SilentTrigger::wait_after(std::uint32_t after, Instant deadline) {
  std::unique_lock lock(mutex_);
  while (last_.number == after) {
    if (clock_.now() >= deadline) return Error{Errc::Timeout, "no trigger pulse came before the deadline"};
    pulsed_.wait_for(lock, std::chrono::milliseconds(2));
  }
  return last_;
}

std::uint32_t SilentTrigger::count() const {
  const std::lock_guard lock(mutex_);
  return last_.number;
}

}  // namespace relievo::hal
