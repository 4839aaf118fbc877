// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Desk: the appliance's half of the staff's side. It opens the door to who has a PIN, keeps the pages'
// halves (DeskPage), and closes everything when they go, or when nobody has touched the screen for long.
//
//   ask(StaffWish), touched(), turn() --> view()
//
// The machine's state Technician (with Calibrate and Export beyond it) is the only one in which a role
// holds. Thread: main. Errors of open(): the store's.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "firmware/bench/bench.h"
#include "firmware/service/consent_shelf.h"
#include "firmware/service/desk_page.h"
#include "firmware/service/device_settings.h"
#include "firmware/service/retention.h"
#include "firmware/service/statistics.h"
#include "firmware/service/touch_trial.h"
#include "firmware/staff/door.h"

namespace relievo::firmware {

class Desk {
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
  static Result<std::unique_ptr<Desk>> open(Parts parts);
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  // The technician's picture pages. Once, before anybody signs in.
  void set_bench(std::unique_ptr<Bench> bench);
  Errands& errands() { return errands_; }
  const Errands& errands() const { return errands_; }

  void ask(const ui::StaffWish& wish);
  void touched();
  // Once every turn of the main loop, after the appliance's.
  void turn();
  // Valid until the next turn().
  const ui::ServiceView& view();

  EventLog& log() { return log_; }
  const EventLog& log() const { return log_; }
  const Statistics& statistics() const { return statistics_; }
  const ui::Settings& settings() const { return settings_.now(); }
  TouchTrial& touch() { return touch_; }
  ConsentShelf& consent() { return consent_; }

 private:
  explicit Desk(Parts parts);
  void let_in();
  void leave();
  void close_page();
  void noted(const Change& change);
  void save_what_changed();
  bool inside() const;
  int seconds_left() const;

  Parts parts_;
  EventLog log_;
  Errands errands_;
  Statistics statistics_;
  DeviceSettings settings_;
  RetentionWatch retention_;
  TouchTrial touch_;
  ConsentShelf consent_;
  ui::ConsentShelfView consent_view_;
  DeskTools tools_;
  Door door_;
  std::uint64_t saved_statistics_ = 0;
  std::array<std::unique_ptr<DeskPage>, static_cast<std::size_t>(ui::StaffPage::Count)> pages_;
  std::unique_ptr<Bench> bench_;
  DeskPage* page_ = nullptr;
  ui::StaffRole role_ = ui::StaffRole::None, waiting_ = ui::StaffRole::None;
  hal::Instant last_touch_{};
  ui::ServiceView view_;
};

}  // namespace relievo::firmware
