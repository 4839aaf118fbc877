// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Watchdog: restarts the appliance when the main loop stops turning.
#pragma once
namespace relievo::hal {

class Watchdog {
 public:
  virtual ~Watchdog() = default;
  virtual void kick() = 0;
};

// Bites nobody. Thread: any.
class NullWatchdog final : public Watchdog {
 public:
  void kick() override {}
};

}  // namespace relievo::hal
