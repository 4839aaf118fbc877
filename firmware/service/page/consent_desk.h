// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of the consent text. What is in force and how the last try ended is in every view (Desk).
// Thread: main.
#pragma once

#include "firmware/service/desk_page.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

class ConsentDesk final : public DeskPage {
 public:
  using DeskPage::DeskPage;
  void opened() override { tools().consent.opened(); }
  void ask(const ui::StaffWish& wish) override {
    if (wish.verb == ui::kConsentTake) tools().consent.take();
  }
  void show(ui::ServiceView&) override {}
};

}  // namespace relievo::firmware
