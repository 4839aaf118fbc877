// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/device.h"

#include <fstream>

#include "hal/linux/mounted_stick.h"
#include "hal/linux/side_by_side.h"

namespace relievo::hal {
namespace {

namespace fs = std::filesystem;

// The kernel counts thousandths of a degree.
std::optional<double> celsius(const fs::path& file) {
  double thousandths = 0;
  if (!(std::ifstream(file) >> thousandths)) return std::nullopt;
  return thousandths / 1000;
}

bool near_switching_off_at(const fs::path& zone) {
  const auto now = celsius(zone / "temp");
  if (!now) return false;
  for (int trip = 0;; ++trip) {
    const std::string name = "trip_point_" + std::to_string(trip);
    std::string kind;
    if (!(std::ifstream(zone / (name + "_type")) >> kind)) return false;  // there are no more
    const auto at = celsius(zone / (name + "_temp"));
    // Firmware that has none writes a temperature that is none.
    if (kind == "critical" && at && *at > 0 && *now >= *at - kHeatMargin) return true;
  }
}

// Cameras that run on their own need no pulse.
class NoLine final : public TriggerLine {
 public:
  using TriggerLine::TriggerLine;

 private:
  Result<void> do_pulse(std::chrono::microseconds, Light light) override {
    if (light == Light::Flash)
      return Error{Errc::Unsupported, "this board has no trigger wire, and so no lamp"};
    return {};
  }
};

class LinuxDevice final : public Device {
 public:
  LinuxDevice(const LinuxDeviceOptions& options, std::unique_ptr<OutputLines> lines, Kernel& kernel)
      : options_(options), first_(options.left, kernel, clock_), stick_(options.stick_folder) {
    if (options.right) second_.emplace(*options.right, kernel, clock_);
    else halves_.emplace(first_);
    if (lines) trigger_ = std::make_unique<GpioTriggerLine>(std::move(lines), options.timing, clock_);
    else trigger_ = std::make_unique<NoLine>(clock_);
  }
  Result<void> arm(const WatchdogOptions& options, Kernel& kernel) {
    RELIEVO_TRY_ASSIGN(watchdog_, open_hardware_watchdog(options, kernel, clock_));
    return {};
  }

  std::string_view name() const override { return "linux"; }
  CaptureMode preferred_mode() const override { return options_.mode; }
  Camera& left() override { return halves_ ? halves_->left() : first_; }
  Camera& right() override { return halves_ ? halves_->right() : *second_; }
  TriggerLine& trigger() override { return *trigger_; }
  // One device exposes both views at once, with a wire or without.
  bool exposes_together() const override { return options_.trigger.has_value() || !options_.right; }
  Light shot_light() const override {
    return options_.trigger && options_.trigger->lamp ? Light::Flash : Light::Off;
  }
  bool too_hot() const override { return near_switching_off("/sys/class/thermal"); }
  RemovableMedia& media() override { return stick_; }
  Clock& clock() override { return clock_; }
  Watchdog& watchdog() override { return *watchdog_; }

 private:
  MonotonicClock clock_;
  LinuxDeviceOptions options_;
  V4l2Camera first_;
  std::optional<V4l2Camera> second_;
  std::optional<SideBySide> halves_;
  std::unique_ptr<TriggerLine> trigger_;
  MountedStick stick_;
  std::unique_ptr<Watchdog> watchdog_ = std::make_unique<NullWatchdog>();
};

}  // namespace

bool near_switching_off(const fs::path& thermal) {
  std::error_code error;
  for (fs::directory_iterator entry(thermal, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with("thermal_zone") && near_switching_off_at(entry->path()))
      return true;
  }
  return false;
}

Result<std::unique_ptr<Device>> make_linux_device(const LinuxDeviceOptions& options, Kernel& kernel) {
  RELIEVO_TRY(options.timing.check());
  std::unique_ptr<OutputLines> lines;
  if (options.trigger) {
    RELIEVO_TRY_ASSIGN(lines, request_gpiod_lines(*options.trigger));
  }
  auto device = std::make_unique<LinuxDevice>(options, std::move(lines), kernel);
  if (options.watchdog) RELIEVO_TRY(device->arm(*options.watchdog, kernel));
  return std::unique_ptr<Device>(std::move(device));
}

}  // namespace relievo::hal
