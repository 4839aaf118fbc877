// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TriggerLine: the wire that makes both sensors expose together, and the lamp's that may flash with it.
//
// The base class, not the caller, keeps the light harmless: of pulses with light, the fourth within a second
// is refused and drives nothing (FlashGuard); a lamp that hangs on the trigger's own wire counts with every
// pulse. A pulse that failed counts too: light may have come. Thread: any; pulses wait for one another.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "hal/base/result.h"
#include "hal/clock.h"

namespace relievo::hal {

// FlashGuard: when the next flash of light may begin, so that in any one second there are at most three
// flashes (WCAG 2.3.1: more can bring on a seizure), whatever anybody asks. A flash counts from its
// first to its last instant. The second after the guard is made is dark: who restarts the program in a
// loop cannot flash more either. Thread: one at a time.
class FlashGuard {
 public:
  static constexpr std::size_t kMostInAWindow = 3;
  // A second, and a little more for clocks and lamps that are not exact.
  static constexpr std::chrono::milliseconds kWindow{1050};

  explicit FlashGuard(Instant now) { ended_.fill(now); }

  Instant allowed_at() const { return ended_[oldest_] + kWindow; }
  bool allows(Instant now) const { return now >= allowed_at(); }
  void flashed(Instant ended) {
    ended_[oldest_] = ended;
    oldest_ = (oldest_ + 1) % kMostInAWindow;
  }

 private:
  std::array<Instant, kMostInAWindow> ended_{};
  std::size_t oldest_ = 0;
};

enum class Light : std::uint8_t { Off, Flash };

class TriggerLine {
 public:
  static constexpr std::chrono::microseconds kLongestPulse{100'000};

  // The clock lives longer than the line.
  explicit TriggerLine(const Clock& clock) : clock_(clock), guard_(clock.now()) {}
  virtual ~TriggerLine() = default;

  // Drives the line active for `width`, then inactive; leaves it inactive on error.
  // InvalidInput: no width, or one over kLongestPulse. Timeout: the light must rest until flash_allowed_at().
  Result<void> pulse(std::chrono::microseconds width, Light light = Light::Off) {
    if (width.count() <= 0 || width > kLongestPulse)
      return invalid("a trigger pulse lasts from 1 microsecond to 0.1 s");
    const std::lock_guard lock(mutex_);
    const bool lit = light == Light::Flash || lights_with_every_pulse();
    const Instant begin = clock_.now();
    if (lit && !guard_.allows(begin))
      return Error{Errc::Timeout, "a fourth flash within one second is refused: it can harm; wait"};
    const Result<void> done = do_pulse(width, light);
    if (lit) guard_.flashed(std::max(begin + width, clock_.now()));
    return done;
  }
  Instant flash_allowed_at() const {
    const std::lock_guard lock(mutex_);
    return guard_.allowed_at();
  }
  virtual bool lights_with_every_pulse() const { return false; }

 protected:
  const Clock& clock_;

 private:
  virtual Result<void> do_pulse(std::chrono::microseconds width, Light light) = 0;

  mutable std::mutex mutex_;
  FlashGuard guard_;
};

}  // namespace relievo::hal
