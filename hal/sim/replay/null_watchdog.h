// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NullWatchdog: counts its kicks and bites nobody.
// Thread: any.
#pragma once

#include <atomic>

#include "hal/watchdog.h"

namespace relievo::hal {

class NullWatchdog final : public Watchdog {
 public:
  void kick() override { ++kicks_; }
  long kicks() const { return kicks_.load(); }

 private:
  std::atomic<long> kicks_{0};
};

}  // namespace relievo::hal
