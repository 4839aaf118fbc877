// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of the touch screen's correction: TouchTrial, which is abandoned with the page. Thread:
// main.
#pragma once

#include "firmware/service/desk_page.h"
#include "firmware/service/touch_trial.h"

namespace relievo::firmware {

class TouchDesk final : public DeskPage {
 public:
  using DeskPage::DeskPage;
  void opened() override { tools().touch.abandon(); }
  void closed() override { tools().touch.abandon(); }
  void ask(const ui::StaffWish& wish) override {
    if (wish.verb == ui::kTouchBegin) tools().touch.begin();
    if (wish.verb == ui::kTouchPlain) tools().touch.take_plain();
  }
  void show(ui::ServiceView& view) override { view.touch = &tools().touch.view(); }
};

}  // namespace relievo::firmware
