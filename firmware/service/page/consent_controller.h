// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of the consent text. What is in force and how the last try ended is in every view
// (StaffController). Thread: main.
#pragma once

#include "firmware/service/page_controller.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

class ConsentController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { services().consent.opened(); }
  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::TakeConsentText>() != nullptr) services().consent.take();
  }
  void show(ui::ServiceView&) override {}
};

}  // namespace relievo::firmware
