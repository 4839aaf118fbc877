// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the staff's first page: the facts its rules judge (ui/screens/service/status_table.h). Disk, sensors
// and calibration are looked at on the keeper, anew every two seconds. Thread: main.
#pragma once

#include "firmware/service/page_controller.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

class StatusController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void show(ui::ServiceView& view) override;

 private:
  void look();
  bool looking_ = false;
  hal::Instant next_look_{};
  ui::StatusView view_;
};

}  // namespace relievo::firmware
