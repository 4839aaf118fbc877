// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FlashGuard: when the next flash of light may begin, so that in any one second there are at most three
// flashes (WCAG 2.3.1: more can bring on a seizure), whatever anybody asks. A flash counts from its
// first to its last instant. The second after the guard is made is dark: who restarts the program in a
// loop cannot flash more either. Thread: one at a time.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "hal/clock.h"

namespace relievo::hal {

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

}  // namespace relievo::hal
