// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/staff/desk_pages.h"

#include "firmware/service/page/consent_desk.h"
#include "firmware/service/page/health_desk.h"
#include "firmware/service/page/records_desk.h"
#include "firmware/service/page/settings_desk.h"
#include "firmware/service/page/statistics_desk.h"
#include "firmware/service/page/test_desks.h"
#include "firmware/service/page/touch_desk.h"
#include "ui/screens/staff_screens.h"

namespace relievo::firmware {

void fill_desk_pages(DeskTools& tools, std::span<std::unique_ptr<DeskPage>> pages) {
  const auto at = [&](ui::StaffPage page) -> std::unique_ptr<DeskPage>& {
    return pages[static_cast<std::size_t>(page)];
  };
  at(ui::StaffPage::Records) = std::make_unique<RecordsDesk>(tools);
  at(ui::StaffPage::Statistics) = std::make_unique<StatisticsDesk>(tools);
  at(ui::StaffPage::Consent) = std::make_unique<ConsentDesk>(tools);
  at(ui::StaffPage::SelfTest) = std::make_unique<SelfTestDesk>(tools);
  at(ui::StaffPage::Trigger) = std::make_unique<TriggerDesk>(tools);
  at(ui::StaffPage::Log) = std::make_unique<LogDesk>(tools);
  at(ui::StaffPage::Health) = std::make_unique<HealthDesk>(tools);
  at(ui::StaffPage::Touch) = std::make_unique<TouchDesk>(tools);
  at(ui::StaffPage::Settings) = std::make_unique<SettingsDesk>(tools);
}

// One table says who may open what: the menu's.
bool may_open(ui::StaffRole role, ui::StaffPage page) {
  for (const ui::StaffPageInfo& info : ui::staff_pages()) {
    if (info.page == page) return ui::may_open(role, info);
  }
  return false;
}

}  // namespace relievo::firmware
