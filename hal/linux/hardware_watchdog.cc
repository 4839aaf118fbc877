// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/device.h"

#include <linux/watchdog.h>

#include <cerrno>

#include "hal/base/words.h"

namespace relievo::hal {
namespace {

constexpr std::chrono::seconds kLeast{2}, kMost{300};

// By what opening it gives.
constexpr Meaning kCannotOpen[] = {
    {{ENOENT, ENODEV, ENXIO},
     Errc::NotFound,
     "there is no watchdog here: load its driver, or leave [watchdog] out"},
    {{EBUSY}, Errc::IoFailed, "another program holds the watchdog: systemd, when RuntimeWatchdogSec is set"},
    {{EACCES, EPERM}, Errc::IoFailed, "this user may not open the watchdog"},
    {{}, Errc::IoFailed, "the watchdog cannot be opened"}};

// The driver rounds, or has a time of its own.
Result<std::chrono::seconds> set_timeout(Kernel& kernel, int file, std::chrono::seconds wanted) {
  int seconds = int(wanted.count());
  const int set = call(kernel, file, WDIOC_SETTIMEOUT, &seconds);
  if (set == -EINVAL)
    return Error{Errc::InvalidInput, "the watchdog cannot wait so long or so short: choose another timeout_s",
                 EINVAL};
  if (set < 0 && call(kernel, file, WDIOC_GETTIMEOUT, &seconds) < 0)
    return Error{Errc::IoFailed, "the watchdog does not tell its time", -set};
  if (seconds < kLeast.count())
    return invalid("the watchdog waits for less than two seconds: the loop may rest so long");
  return std::chrono::seconds(seconds);
}

// A driver that never rests ("nowayout") restarts the machine once nobody kicks it: nothing can be done about
// that.
void put_to_rest(Kernel& kernel, int file) {
  int rest = WDIOS_DISABLECARD;
  (void)call(kernel, file, WDIOC_SETOPTIONS, &rest);
  kernel.close(file);
}

class HardwareWatchdog final : public Watchdog {
 public:
  HardwareWatchdog(Kernel& kernel, const Clock& clock, int file, std::chrono::seconds timeout)
      : kernel_(kernel), clock_(clock), file_(file), timeout_(timeout) {}
  ~HardwareWatchdog() override { put_to_rest(kernel_, file_); }

  void kick() override {
    const Instant now = clock_.now();
    if (now < next_) return;
    next_ = now + std::chrono::duration_cast<Instant::duration>(timeout_) / 4;
    int none = 0;
    (void)call(kernel_, file_, WDIOC_KEEPALIVE, &none);  // what it refuses, the watchdog itself punishes
  }

 private:
  Kernel& kernel_;
  const Clock& clock_;
  int file_;
  std::chrono::seconds timeout_;
  Instant next_{};
};

}  // namespace

Result<void> WatchdogOptions::check() const {
  if (device.empty()) return invalid("the watchdog's device is missing").at("[watchdog]");
  if (timeout < kLeast || timeout > kMost) return invalid("timeout_s must lie in 2 .. 300").at("[watchdog]");
  return {};
}

Result<std::unique_ptr<Watchdog>> open_hardware_watchdog(const WatchdogOptions& options, Kernel& kernel,
                                                         const Clock& clock) {
  RELIEVO_TRY(options.check());
  const int file = open_device(kernel, options.device.c_str());
  if (file < 0) return meaning_of(-file, kCannotOpen).at(options.device);
  const auto timeout = set_timeout(kernel, file, options.timeout);
  if (!timeout) {
    put_to_rest(kernel, file);
    return timeout.error().at(options.device);
  }
  return std::unique_ptr<Watchdog>(std::make_unique<HardwareWatchdog>(kernel, clock, file, *timeout));
}

}  // namespace relievo::hal
