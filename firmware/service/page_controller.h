// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PageController: what lies behind one page of the staff's side: the real objects. The screen's half is a
// function in ui/screens/service/; this half answers its requests and fills its view.
//
//   opened() -> ask(request) ... show(view) every frame -> closed()
//
// What takes longer than a glance goes to SideTasks. closed() leaves nothing of anybody in memory.
// Thread: main. Errors: told in ServiceView::work.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "firmware/records/event_log.h"
#include "firmware/service/consent_text_store.h"
#include "firmware/service/device_settings.h"
#include "firmware/service/side_tasks.h"
#include "firmware/service/statistics.h"
#include "firmware/service/touch_trial.h"
#include "hal/device.h"
#include "storage/store.h"
#include "ui/view/service.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

// What a page may use. Borrowed; everything outlives the pages.
struct PageServices {
  Appliance& appliance;
  hal::Device& device;
  storage::Store& store;  // on the keeper only
  SideTasks& side_tasks;
  EventLog& log;
  Statistics& statistics;
  const VisitCosts& costs;
  DeviceSettings& settings;
  RetentionWatch& retention;
  TouchTrial& touch;
  ConsentTextStore& consent;
  std::filesystem::path folder;              // of the store
  const std::uint32_t& calibration;          // the revision that is measured with, 0 for none; main thread
  ui::StaffRole role = ui::StaffRole::None;  // of who is signed in
  bool words_due = false;                    // no recovery words open the store yet
};

class PageController {
 public:
  explicit PageController(PageServices& services) : services_(services) {}
  virtual ~PageController() = default;
  PageController& operator=(PageController&&) = delete;

  virtual void opened() {}
  virtual void ask(const ui::StaffRequest&) {}
  virtual void show(ui::ServiceView& view) = 0;
  virtual void closed() {}
  // While nobody is visiting, whether the page is open or not.
  virtual void turn() {}

 protected:
  PageServices& services() { return services_; }
  const PageServices& services() const { return services_; }

 private:
  PageServices& services_;
};

// What lies behind the pages (page/).
std::unique_ptr<PageController> health_controller(PageServices& services);
std::unique_ptr<PageController> log_controller(PageServices& services);
std::unique_ptr<PageController> records_controller(PageServices& services);
std::unique_ptr<PageController> recovery_controller(PageServices& services);
std::unique_ptr<PageController> self_test_controller(PageServices& services);
std::unique_ptr<PageController> status_controller(PageServices& services);
std::unique_ptr<PageController> trigger_controller(PageServices& services);

// What an error means to who asked.
ui::Outcome outcome_of(const Error& error);

}  // namespace relievo::firmware
