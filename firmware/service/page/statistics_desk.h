// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of statistics. Thread: main.
#pragma once

#include "firmware/service/desk_page.h"

namespace relievo::firmware {

class StatisticsDesk final : public DeskPage {
 public:
  using DeskPage::DeskPage;
  void show(ui::ServiceView& view) override {
    view_ = tools().statistics.view();
    view.statistics = &view_;
  }

 private:
  ui::StatisticsView view_;
};

}  // namespace relievo::firmware
