// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/heat.h"

#include <fstream>
#include <optional>
#include <string>

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

}  // namespace

bool near_switching_off(const fs::path& thermal) {
  std::error_code error;
  for (fs::directory_iterator entry(thermal, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with("thermal_zone") && near_switching_off_at(entry->path()))
      return true;
  }
  return false;
}

}  // namespace relievo::hal
