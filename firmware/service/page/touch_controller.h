// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of the touch screen's correction: TouchTrial, which is abandoned with the page. Thread:
// main.
#pragma once

#include "firmware/service/page_controller.h"
#include "firmware/service/touch_trial.h"

namespace relievo::firmware {

class TouchController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { services().touch.abandon(); }
  void closed() override { services().touch.abandon(); }
  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::BeginTouchTrial>() != nullptr) services().touch.begin();
    if (request.as<ui::TakePlainTouch>() != nullptr) services().touch.take_plain();
  }
  void show(ui::ServiceView& view) override { view.touch = &services().touch.view(); }
};

}  // namespace relievo::firmware
