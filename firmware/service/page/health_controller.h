// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of health: the memory plan (budget.h) against what the last visits used at most, the disk's
// room, temperatures where the kernel tells them (/sys/class/thermal), the last faults. Looked at anew every
// two seconds, on the keeper: a disk or a sensor may be slow; while the page is closed every ten minutes, so
// that it can show the last day. Thread: main.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "firmware/service/page_controller.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

struct Sensor {
  std::string name;
  double celsius = 0;
};
// All of `thermal` (/sys/class/thermal); none where there are none.
std::vector<Sensor> read_temperatures(const std::filesystem::path& thermal);

// The last 24 hours of a figure, from the start on. The newest stands at the end.
class DayRing {
 public:
  static constexpr std::chrono::minutes kEvery{10};
  static constexpr std::size_t kKept = std::chrono::hours(24) / kEvery;
  DayRing() { all_.fill(std::numeric_limits<float>::quiet_NaN()); }
  void add(double value) {
    std::shift_left(all_.begin(), all_.end(), 1);
    all_.back() = float(value);
  }
  std::span<const float> values() const { return all_; }

 private:
  std::array<float, kKept> all_{};
};

}  // namespace relievo::firmware
