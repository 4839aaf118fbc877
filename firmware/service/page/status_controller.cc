// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page/status_controller.h"

#include <algorithm>
#include <memory>

#include "firmware/service/page/health_controller.h"

namespace relievo::firmware {
namespace {

constexpr std::chrono::seconds kBetweenLooks{2};

// A visitor without a face, or one who left, is no fault of the device.
bool is_of_the_device(Errc code) {
  return code == Errc::Disconnected || code == Errc::Timeout || code == Errc::OutOfMemory ||
         code == Errc::LibraryFailed || code == Errc::IoFailed || code == Errc::MediaFull ||
         code == Errc::StoreCorrupt || code == Errc::StoreNewer;
}

std::uint64_t missed(const CameraCounts& counts) {
  return counts.late + counts.lost + counts.damaged + counts.too_short + counts.missing;
}

}  // namespace

// What was seen before stays until it is seen anew: nothing moves away from a finger.
void StatusController::opened() { next_look_ = {}; }

void StatusController::look() {
  looking_ = true;
  const auto seen = std::make_shared<ui::StatusView>();
  services().side_tasks.send(
      JobLane::Keeper,
      [seen, &store = services().store, folder = services().folder, revision = services().calibration,
       now = services().device.clock().wall_now()](JobControl&) -> Result<void> {
        for (const Sensor& sensor : read_temperatures("/sys/class/thermal"))
          seen->hottest_c = std::max(seen->hottest_c, sensor.celsius);
        std::error_code none;
        seen->free_mib = static_cast<double>(std::filesystem::space(folder, none).available) / (1 << 20);
        if (none) return Error{Errc::IoFailed, "the disk does not tell how much room it has"};
        RELIEVO_TRY_ASSIGN(const auto calibrations, store.calibrations());
        for (const storage::CalibrationInfo& one : calibrations) {
          if (one.revision == revision)
            seen->calibration_days =
                static_cast<int>(std::chrono::floor<std::chrono::days>(now - one.created_at).count());
        }
        return {};
      },
      [this, seen](const std::optional<Error>& error) {
        looking_ = false;
        next_look_ = services().device.clock().now() + kBetweenLooks;
        if (error) return services().log.fault(*error);
        view_ = *seen;
        view_.looked = true;
      });
}

void StatusController::show(ui::ServiceView& view) {
  PageServices& all = services();
  if (!looking_ && all.device.clock().now() >= next_look_) look();
  view_.camera_away = all.appliance.cameras() != CameraWatch::Well;
  const GrabCounts& counts = all.appliance.grabber().counts();
  view_.pairs = counts.pairs;
  view_.missed = counts.slipped + missed(counts.left) + missed(counts.right);
  view_.clock_jumped = all.retention.clock_jumped();
  view_.store_damaged = false;
  view_.device_faults = 0;
  for (const LogEntry& fault : all.log.faults()) {
    if (!fault.code || !is_of_the_device(*fault.code)) continue;
    ++view_.device_faults;
    view_.store_damaged = view_.store_damaged || *fault.code == Errc::StoreCorrupt;
  }
  view.status = &view_;
}

}  // namespace relievo::firmware
