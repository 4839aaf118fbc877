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

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "firmware/records/event_log.h"
#include "firmware/service/consent_text_store.h"
#include "firmware/service/device_settings.h"
#include "firmware/service/side_tasks.h"
#include "firmware/service/statistics.h"
#include "firmware/service/touch_trial.h"
#include "hal/device.h"
#include "storage/store.h"
#include "ui/view/service.h"
#include "ui/view/staff_views.h"
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

// What lies behind the pages (page/). device_controller(): behind Menu, Recovery, SelfTest, Trigger, Log.
std::unique_ptr<PageController> device_controller(PageServices& services, ui::StaffPage page);
std::unique_ptr<PageController> health_controller(PageServices& services);
std::unique_ptr<PageController> records_controller(PageServices& services);

// What an error means to who asked.
ui::Outcome outcome_of(const Error& error);

// Behind the page of health: the memory plan (budget.h) against what the last visits used at most, the disk's
// room, temperatures where the kernel tells them (/sys/class/thermal), the last faults. Looked at anew every
// two seconds, on the keeper: a disk or a sensor may be slow; while the page is closed every ten minutes, so
// that it can show the last day. Thread: main.
struct Sensor {
  std::string name;
  double celsius = 0;
};
// All of `thermal` (/sys/class/thermal); none where there are none.
std::vector<Sensor> read_temperatures(const std::filesystem::path& thermal);

// The last 24 hours of a figure, from the start on. The newest stands at the end.
class DayRing {
 public:
  static constexpr std::chrono::minutes kEvery{10};
  static constexpr std::size_t kKept = std::chrono::hours(24) / kEvery;
  DayRing() { all_.fill(std::numeric_limits<float>::quiet_NaN()); }
  void add(double value) {
    std::shift_left(all_.begin(), all_.end(), 1);
    all_.back() = float(value);
  }
  std::span<const float> values() const { return all_; }

 private:
  std::array<float, kKept> all_{};
};

}  // namespace relievo::firmware
