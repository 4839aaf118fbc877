// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/staff/page_controllers.h"

#include "firmware/service/page/health_controller.h"
#include "firmware/service/page/records_controller.h"
#include "firmware/service/page/recovery_controller.h"
#include "firmware/service/page/status_controller.h"
#include "firmware/service/page/test_controllers.h"
#include "ui/device/settings.h"
#include "ui/screens/staff_screens.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

// What is in force and how the last try ended is in every view (StaffController).
class ConsentController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { services().consent.opened(); }
  void ask(const ui::StaffRequest& request) override {
    if (request.as<ui::TakeConsentText>() != nullptr) services().consent.take();
  }
  void show(ui::ServiceView&) override {}
};

// Each role changes those that are theirs.
class SettingsController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { outcome_ = ui::Outcome::None; }
  void ask(const ui::StaffRequest& request) override {
    const auto* asked = request.as<ui::ChangeSetting>();
    if (asked == nullptr) return;
    const ui::Setting setting = asked->setting;
    const ui::SettingInfo& info = info_of(setting);
    if (!(services().role == ui::StaffRole::Technician ? info.technician : info.clerk)) return;
    const std::int32_t value = services().settings.wanted().beside(setting, asked->more ? 1 : -1);
    services().settings.change(setting, value, [this](const std::optional<Error>& error) {
      outcome_ = error ? outcome_of(*error) : ui::Outcome::Done;
    });
    if (setting == ui::Setting::KeepDays) services().retention.begin_anew();
  }
  void show(ui::ServiceView& view) override {
    view.work.outcome = outcome_;
    view_ = {services().settings.wanted(), services().retention.clock_jumped()};
    view.settings = &view_;
  }

 private:
  ui::Outcome outcome_ = ui::Outcome::None;
  ui::SettingsView view_;
};

class StatisticsController final : public PageController {
 public:
  using PageController::PageController;
  void show(ui::ServiceView& view) override {
    view_ = services().statistics.view(
        std::chrono::floor<std::chrono::days>(services().device.clock().wall_now()));
    view.statistics = &view_;
  }

 private:
  ui::StatisticsView view_;
};

// TouchTrial is abandoned with the page.
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

// Behind one of the technician's seven picture pages, which share one TestCapture.
class TechnicianController final : public PageController {
 public:
  TechnicianController(PageServices& services, TestCapture& test_capture, ui::TechnicianPage page)
      : PageController(services), test_capture_(test_capture), page_(page) {}
  void opened() override { test_capture_.opened(page_); }
  void ask(const ui::StaffRequest& request) override {
    if (const auto* asked = request.as<ui::TechnicianRequest>()) test_capture_.act(*asked);
    if (const auto* list = request.as<ui::ListRequest>()) test_capture_.act(ui::TechnicianRequest(*list));
  }
  void show(ui::ServiceView& view) override {
    view.technician = &test_capture_.view();
    if (page_ == ui::TechnicianPage::Stages || page_ == ui::TechnicianPage::Compare)
      view.work = {view.technician->recording.running, view.technician->recording.progress,
                   view.technician->recording.outcome};
    view.inner = page_ == ui::TechnicianPage::Algorithms && view.technician->choice.edited != nullptr;
  }
  void closed() override { test_capture_.closed(page_); }

 private:
  TestCapture& test_capture_;
  ui::TechnicianPage page_;
};

}  // namespace

void fill_page_controllers(PageServices& services, Pages pages) {
  const auto at = [&](ui::StaffPage page) -> std::unique_ptr<PageController>& {
    return pages[static_cast<std::size_t>(page)];
  };
  at(ui::StaffPage::Menu) = std::make_unique<StatusController>(services);
  at(ui::StaffPage::Records) = std::make_unique<RecordsController>(services);
  at(ui::StaffPage::Statistics) = std::make_unique<StatisticsController>(services);
  at(ui::StaffPage::Consent) = std::make_unique<ConsentController>(services);
  at(ui::StaffPage::Recovery) = std::make_unique<RecoveryController>(services);
  at(ui::StaffPage::SelfTest) = std::make_unique<SelfTestController>(services);
  at(ui::StaffPage::Trigger) = std::make_unique<TriggerController>(services);
  at(ui::StaffPage::Log) = std::make_unique<LogController>(services);
  at(ui::StaffPage::Health) = std::make_unique<HealthController>(services);
  at(ui::StaffPage::Touch) = std::make_unique<TouchController>(services);
  at(ui::StaffPage::Settings) = std::make_unique<SettingsController>(services);
}

void fill_technician_pages(PageServices& services, TestCapture& test_capture, Pages pages) {
  for (int i = 0; i <= static_cast<int>(ui::TechnicianPage::Calibrate); ++i)
    pages[static_cast<std::size_t>(ui::StaffPage::Stages) + static_cast<std::size_t>(i)] =
        std::make_unique<TechnicianController>(services, test_capture, static_cast<ui::TechnicianPage>(i));
}

// One table says who may open what: the menu's.
bool may_open(ui::StaffRole role, ui::StaffPage page) {
  for (const ui::StaffPageInfo& info : ui::staff_pages()) {
    if (info.page == page) return ui::may_open(role, info);
  }
  return false;
}

}  // namespace relievo::firmware
