// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of settings: each role changes those that are theirs. Thread: main.
#pragma once

#include "firmware/service/page_controller.h"
#include "ui/device/settings.h"

namespace relievo::firmware {

class SettingsController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void ask(const ui::StaffRequest& request) override;
  void show(ui::ServiceView& view) override;

 private:
  ui::Outcome outcome_ = ui::Outcome::None;
  ui::SettingsView view_;
};

}  // namespace relievo::firmware
