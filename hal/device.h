// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The hardware of one appliance as a whole, and what may be plugged into it beside.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "hal/base/result.h"
#include "hal/camera.h"
#include "hal/clock.h"
#include "hal/removable_media.h"
#include "hal/trigger_line.h"

namespace relievo::hal {

// Watchdog: restarts the appliance when the main loop stops turning.
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

// InputSwitch: something of the machine that is on or off. Thread: its owner's. Errors: none.
class InputSwitch {
 public:
  virtual ~InputSwitch() = default;
  virtual bool is_on() = 0;
};

// Printer: a slip of paper for who wants one. Both calls may take seconds: never the main thread's. Errors:
// NotFound (there is none), IoFailed (it does not take it).
class Printer {
 public:
  virtual ~Printer() = default;
  virtual bool is_there() = 0;
  virtual Result<void> print(std::span<const std::byte> png) = 0;
};

// Device: opened and closed as a whole. It owns its cameras, wires, sticks and clock; the references stay
// valid as long as it lives. Which device it is, firmware/main.cc says.
class Device {
 public:
  virtual ~Device() = default;
  virtual std::string_view name() const = 0;  // "sim", "folder", "linux"
  // The mode in which this device's cameras give their best picture.
  virtual CaptureMode preferred_mode() const = 0;
  virtual Camera& left() = 0;  // left as the cameras see it: the image's left half of the pair
  virtual Camera& right() = 0;
  virtual TriggerLine& trigger() = 0;
  // Do both cameras expose at the trigger's pulse? If not, they run on their own, or did when recorded.
  virtual bool exposes_together() const { return true; }
  // Does somebody stand before the cameras? Recorded and simulated pairs do not get better by taking more.
  virtual bool is_live() const { return true; }
  // Flash where a lamp of its own hangs on the trigger.
  virtual Light shot_light() const { return Light::Off; }
  // Is a part of it about to switch the machine off for its heat? Thread: any; waits for the sensors.
  virtual bool too_hot() const { return false; }
  virtual RemovableMedia& media() = 0;
  virtual Clock& clock() = 0;
  virtual Watchdog& watchdog() = 0;
};

}  // namespace relievo::hal
