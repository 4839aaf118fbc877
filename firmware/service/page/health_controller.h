// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of health: the memory plan (budget.h) against what was used at most, the disk's room,
// temperatures where the kernel tells them (/sys/class/thermal), the last faults. Looked at anew every
// two seconds, on the keeper: a disk or a sensor may be slow. Thread: main.
#pragma once

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

class HealthController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void show(ui::ServiceView& view) override;
  void closed() override;

 private:
  struct Seen {
    std::vector<Sensor> sensors;
    double disk_used_mib = 0, disk_mib = 0, process_mib = 0;
  };
  void look();
  void add_memory();
  void add_seen();

  bool open_ = false, looking_ = false;
  hal::Instant next_look_{};
  Seen seen_;
  bool ready_ = false;
  std::vector<ui::GaugeRow> rows_;
  std::vector<LogEntry> faults_;
  std::vector<ui::LogLine> fault_lines_;
  ui::HealthView view_;
};

}  // namespace relievo::firmware
