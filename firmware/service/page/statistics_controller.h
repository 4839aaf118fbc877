// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of statistics. Thread: main.
#pragma once

#include "firmware/service/page_controller.h"

namespace relievo::firmware {

class StatisticsController final : public PageController {
 public:
  using PageController::PageController;
  void show(ui::ServiceView& view) override {
    view_ = services().statistics.view();
    view.statistics = &view_;
  }

 private:
  ui::StatisticsView view_;
};

}  // namespace relievo::firmware
