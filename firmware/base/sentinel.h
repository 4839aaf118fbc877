// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sentinel: ends a program that hangs. The main loop kicks it before the work and before the drawing of every
// turn, and whoever waits for a thread that does not end does not kick: so a frozen main loop and any frozen
// thread somebody needs are noticed alike.
// What supervises the program (systemd with Restart=always) then starts it anew; nothing of a visitor
// outlives the process. A hardware watchdog stands behind it, for a machine that hangs as a whole.
//
// Thread: kick() main; `hangs` is called on a thread of its own, once a hang.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "hal/clock.h"

namespace relievo::firmware {

class Sentinel {
 public:
  // The clock outlives it.
  explicit Sentinel(const hal::Clock& clock, std::function<void()> hangs = end_program);
  ~Sentinel();
  Sentinel& operator=(Sentinel&&) = delete;

  // From the first on it is waited for.
  void kick() { kicked_.store(clock_.now().time_since_epoch().count(), std::memory_order_relaxed); }

  // Says why on standard error and aborts.
  [[noreturn]] static void end_program();

 private:
  void watch();

  const hal::Clock& clock_;
  std::function<void()> hangs_;
  std::atomic<hal::Instant::rep> kicked_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace relievo::firmware
