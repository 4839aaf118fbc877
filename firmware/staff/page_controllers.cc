// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/staff/page_controllers.h"

#include "firmware/service/page/consent_controller.h"
#include "firmware/service/page/health_controller.h"
#include "firmware/service/page/records_controller.h"
#include "firmware/service/page/settings_controller.h"
#include "firmware/service/page/statistics_controller.h"
#include "firmware/service/page/test_controllers.h"
#include "firmware/service/page/touch_controller.h"
#include "ui/screens/staff_screens.h"

namespace relievo::firmware {

void fill_page_controllers(PageServices& services, std::span<std::unique_ptr<PageController>> pages) {
  const auto at = [&](ui::StaffPage page) -> std::unique_ptr<PageController>& {
    return pages[static_cast<std::size_t>(page)];
  };
  at(ui::StaffPage::Records) = std::make_unique<RecordsController>(services);
  at(ui::StaffPage::Statistics) = std::make_unique<StatisticsController>(services);
  at(ui::StaffPage::Consent) = std::make_unique<ConsentController>(services);
  at(ui::StaffPage::SelfTest) = std::make_unique<SelfTestController>(services);
  at(ui::StaffPage::Trigger) = std::make_unique<TriggerController>(services);
  at(ui::StaffPage::Log) = std::make_unique<LogController>(services);
  at(ui::StaffPage::Health) = std::make_unique<HealthController>(services);
  at(ui::StaffPage::Touch) = std::make_unique<TouchController>(services);
  at(ui::StaffPage::Settings) = std::make_unique<SettingsController>(services);
}

// One table says who may open what: the menu's.
bool may_open(ui::StaffRole role, ui::StaffPage page) {
  for (const ui::StaffPageInfo& info : ui::staff_pages()) {
    if (info.page == page) return ui::may_open(role, info);
  }
  return false;
}

}  // namespace relievo::firmware
