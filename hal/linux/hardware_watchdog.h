// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HardwareWatchdog: the kernel's watchdog device (Documentation/watchdog/watchdog-api.rst). From open() on
// the machine is restarted when nobody kicks it for the given time, the process having died included; a
// destroyed watchdog is at rest again, where the driver lets it. Thread: main.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "hal/base/result.h"
#include "hal/clock.h"
#include "hal/linux/kernel.h"
#include "hal/watchdog.h"

namespace relievo::hal {

struct WatchdogOptions {
  std::string device = "/dev/watchdog";
  std::chrono::seconds timeout{10};
  Result<void> check() const;  // InvalidInput
};

class HardwareWatchdog final : public Watchdog {
 public:
  // The device is armed when this returns. A driver whose time is fixed keeps its own, two seconds at the
  // least. Errors: InvalidInput, NotFound (no such device), IoFailed (in use, not allowed, the driver
  // refuses).
  static Result<std::unique_ptr<HardwareWatchdog>> open(const WatchdogOptions& options, Kernel& kernel,
                                                        const Clock& clock);
  ~HardwareWatchdog() override;
  HardwareWatchdog(const HardwareWatchdog&) = delete;
  HardwareWatchdog& operator=(const HardwareWatchdog&) = delete;

  // As often as the loop turns; the device hears four in its time.
  void kick() override;
  std::chrono::seconds timeout() const { return timeout_; }

 private:
  HardwareWatchdog(Kernel& kernel, const Clock& clock, int file, std::chrono::seconds timeout)
      : kernel_(kernel), clock_(clock), file_(file), timeout_(timeout) {}
  Kernel& kernel_;
  const Clock& clock_;
  int file_;
  std::chrono::seconds timeout_;
  Instant next_{};
};

}  // namespace relievo::hal
