// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// MonotonicClock: the machine's own time; the clock of every device that runs in real time.
// Thread: any.
#pragma once

#include "hal/clock.h"

namespace relievo::hal {

class MonotonicClock final : public Clock {
 public:
  Instant now() const override { return std::chrono::steady_clock::now(); }
  std::chrono::system_clock::time_point wall_now() const override { return std::chrono::system_clock::now(); }
};

}  // namespace relievo::hal
