// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffController: the appliance's half of the staff's side. It signs in who has a PIN, keeps the pages'
// controllers, and closes everything when they go, or when nobody has touched the screen for long.
//
//   ask(StaffRequest), touched(), turn() --> view()
//
// The machine's state Staff (with Calibrate and Export beyond it) is the only one in which a role
// holds. Thread: main. Errors of open(): the store's.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "firmware/service/consent_text_store.h"
#include "firmware/service/device_settings.h"
#include "firmware/service/page_controller.h"
#include "firmware/service/retention.h"
#include "firmware/service/statistics.h"
#include "firmware/service/touch_trial.h"
#include "firmware/staff/sign_in.h"
#include "firmware/technician/test_capture.h"

namespace relievo::firmware {

class StaffController {
 public:
  struct Parts {
    Appliance& appliance;
    hal::Device& device;
    storage::Store& store;
    std::filesystem::path folder;      // of the store: for the log's file and the disk's room
    const std::uint32_t& calibration;  // the revision that is measured with, 0 for none
    SetClock set_clock;
  };
  // Before a thread uses the store.
  static Result<std::unique_ptr<StaffController>> open(Parts parts);
  ~StaffController();
  StaffController(const StaffController&) = delete;
  StaffController& operator=(const StaffController&) = delete;

  // The technician's picture pages. Once, before anybody signs in.
  void set_test_capture(std::unique_ptr<TestCapture> test_capture);
  SideTasks& side_tasks() { return side_tasks_; }
  const SideTasks& side_tasks() const { return side_tasks_; }

  void ask(const ui::StaffRequest& request);
  void touched();
  // Once every turn of the main loop, after the appliance's.
  void turn();
  // Valid until the next turn().
  const ui::ServiceView& view();

  EventLog& log() { return log_; }
  const EventLog& log() const { return log_; }
  const ui::Settings& settings() const { return settings_.now(); }
  TouchTrial& touch() { return touch_; }
  ConsentTextStore& consent() { return consent_; }

 private:
  explicit StaffController(Parts parts);
  void let_in();
  void leave();
  void close_page();
  void noted(const Transition& change);
  void save_what_changed();
  bool inside() const;
  int seconds_left() const;

  Parts parts_;
  EventLog log_;
  SideTasks side_tasks_;
  Statistics statistics_;
  VisitCosts costs_;
  DeviceSettings settings_;
  RetentionWatch retention_;
  TouchTrial touch_;
  ConsentTextStore consent_;
  ui::ConsentTextsView consent_view_;
  PageServices services_;
  SignIn sign_in_;
  std::array<std::unique_ptr<PageController>, std::size_t(ui::StaffPage::Count)> pages_;
  std::unique_ptr<TestCapture> test_capture_;
  PageController* page_ = nullptr;
  ui::StaffRole role_ = ui::StaffRole::None, waiting_ = ui::StaffRole::None;
  hal::Instant last_touch_{};
  float kept_ = 0;  // of the keeper's work, a turn ago
  ui::ServiceView view_;
};

}  // namespace relievo::firmware
