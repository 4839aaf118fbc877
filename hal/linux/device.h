// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The appliance's own hardware: V4L2 cameras, two or one that gives both views side by side, and a GPIO
// trigger with or without a lamp; without a trigger the cameras run on their own. What is wired where
// stands in a TOML file (README.md).
// Thread: making: main; the devices as their headers say.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "hal/base/result.h"
#include "hal/device.h"
#include "hal/linux/hardware_watchdog.h"
#include "hal/linux/kernel.h"
#include "hal/linux/v4l2_camera.h"
#include "hal/linux/wire/gpio_trigger_line.h"
#include "hal/linux/wire/output_lines.h"

namespace relievo::hal {

// Heat: how near the machine is to switching itself off, as the kernel tells it: each thermal zone with its
// temperature and its critical trip point (Documentation/driver-api/thermal/sysfs-api). Thread: any.

// Degrees below its critical point at which a zone counts.
inline constexpr double kHeatMargin = 5;

// Is any zone of `thermal` (/sys/class/thermal) so near? A zone that tells no temperature or no critical
// point is none.
bool near_switching_off(const std::filesystem::path& thermal);

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

}  // namespace relievo::hal
