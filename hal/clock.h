// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clock: the only source of time. Tests advance theirs by hand.
#pragma once

#include <chrono>

namespace relievo::hal {

using Instant = std::chrono::steady_clock::time_point;

class Clock {
 public:
  virtual ~Clock() = default;
  virtual Instant now() const = 0;
  virtual std::chrono::system_clock::time_point wall_now() const = 0;
};

// MonotonicClock: the machine's own time; the clock of every device that runs in real time. Thread: any.
class MonotonicClock final : public Clock {
 public:
  Instant now() const override { return std::chrono::steady_clock::now(); }
  std::chrono::system_clock::time_point wall_now() const override { return std::chrono::system_clock::now(); }
};

}  // namespace relievo::hal
