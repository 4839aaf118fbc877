// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The appliance's own hardware: V4L2 cameras, two or one that gives both views side by side, and a GPIO
// trigger with or without a lamp; without a trigger the cameras run on their own. What is wired where
// stands in a TOML file (README.md).
// Thread: making: main; the devices as their headers say.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "hal/base/result.h"
#include "hal/clock.h"
#include "hal/device.h"
#include "hal/linux/kernel.h"
#include "hal/linux/v4l2_camera.h"
#include "hal/linux/wire/gpio_trigger_line.h"

namespace relievo::hal {

// Heat: how near the machine is to switching itself off, as the kernel tells it: each thermal zone with its
// temperature and its critical trip point (Documentation/driver-api/thermal/sysfs-api). Thread: any.

// Degrees below its critical point at which a zone counts.
inline constexpr double kHeatMargin = 5;

// Is any zone of `thermal` (/sys/class/thermal) so near? A zone that tells no temperature or no critical
// point is none.
bool near_switching_off(const std::filesystem::path& thermal);

// The kernel's watchdog device (Documentation/watchdog/watchdog-api.rst). From its opening on the machine is
// restarted when nobody kicks it for the given time, the process having died included; it is to be kicked as
// often as the loop turns, and hears four kicks in its time. Destroyed it is at rest again, where the driver
// lets it. A driver whose time is fixed keeps its own, two seconds at the least. Thread: main.
struct WatchdogOptions {
  std::string device = "/dev/watchdog";
  std::chrono::seconds timeout{10};
  Result<void> check() const;  // InvalidInput
};
// Errors: InvalidInput, NotFound (no such device), IoFailed (in use, not allowed, the driver refuses).
Result<std::unique_ptr<Watchdog>> open_hardware_watchdog(const WatchdogOptions& options, Kernel& kernel,
                                                         const Clock& clock);

struct LinuxDeviceOptions {
  CaptureMode mode;
  V4l2CameraOptions left;                  // or both views
  std::optional<V4l2CameraOptions> right;  // none: the left device gives both views
  std::optional<GpioOptions> trigger;      // none: the cameras run on their own
  GpioTiming timing;
  std::string stick_folder;  // empty: no stick
  std::optional<WatchdogOptions> watchdog;
};

// Errors: NotFound (no file), InvalidInput (a word, a number or a table that cannot be used, named by its
// line), IoFailed.
Result<LinuxDeviceOptions> read_linux_device_file(const std::filesystem::path& file);

// Requests the GPIO lines and arms the watchdog; the cameras open when the appliance asks. Errors: the
// lines', the watchdog's.
Result<std::unique_ptr<Device>> make_linux_device(const LinuxDeviceOptions& options,
                                                  Kernel& kernel = real_kernel());

// The default printer of CUPS, as the system has it (lpadmin -d). What is printed goes to it from memory.
std::unique_ptr<Printer> make_cups_printer();

// Switches of input devices, as the kernel tells of them: headphones in the jack of a sound card
// (SW_HEADPHONE_INSERT), somebody before a presence sensor (SW_FRONT_PROXIMITY). Their state is asked for, so
// that no event can be missed.
// Thread: one. Errors: none: what cannot be read is off. The program must be in the group input.
// Looked for once, in /dev/input/event0 to event31; on if one of them is. Empty: there is none.
std::unique_ptr<InputSwitch> find_headphone_jack(Kernel& kernel = real_kernel());
std::unique_ptr<InputSwitch> find_presence_sensor(Kernel& kernel = real_kernel());

}  // namespace relievo::hal
