// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the technician's tests: SelfTestController asks memory, store, calibration, disk and cameras;
// TriggerController pulses the line and counts what both cameras saw; LogController shows the lines of the
// log, the newest first. The store is read on the keeper, cameras are asked on the capture thread; the
// pictures of a test are wiped before it is reported. Thread: main.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/service/page_controller.h"
#include "hal/picture_file.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

// Behind the page of the recovery sheet: words are drawn when it is opened, and hold when two of them were
// typed; then it shows none again. A sheet that is left before is worth nothing. Thread: main; the store is
// written on the keeper.
class RecoveryController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void ask(const ui::StaffRequest& request) override;
  void show(ui::ServiceView& view) override;
  void closed() override;

 private:
  void keep();

  std::string words_;                     // wiped when the page is left, or they are kept
  std::vector<std::string_view> each_;    // of words_
  std::array<std::size_t, 2> to_type_{};  // which, from 0
  std::size_t typed_ = 0;                 // how many of the two were right
  hal::Picture code_;
  std::uint32_t version_ = 0;
  ui::SheetState state_ = ui::SheetState::Asked;
  ui::Outcome outcome_ = ui::Outcome::None;
  ui::RecoveryView view_;
};

// Behind the staff's first page: the facts its rules judge (ui/screens/service/status_table.h). Disk, sensors
// and calibration are looked at on the keeper, anew every two seconds. Thread: main.
class StatusController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void show(ui::ServiceView& view) override;
  void closed() override { looking_ = false; }  // what is under way may be forgotten with the page

 private:
  void look();
  bool looking_ = false;
  hal::Instant next_look_{};
  ui::StatusView view_;
};

class SelfTestController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void ask(const ui::StaffRequest& request) override;
  void show(ui::ServiceView& view) override;
  void closed() override;

 private:
  void begin(ui::Check check, JobLane lane, SideTasks::Work work);
  std::uint32_t visit_ = 0;
  int running_ = 0;  // of this visit
  ui::SelfTestView view_;
};

class TriggerController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void ask(const ui::StaffRequest& request) override;
  void show(ui::ServiceView& view) override;
  void closed() override;

 private:
  static constexpr int kPulses = 10;
  std::uint32_t visit_ = 0;
  bool running_ = false;  // of this visit
  std::uint32_t task_ = 0;
  ui::TriggerView view_;
};

class LogController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override { walk_.begin_anew(); }
  void ask(const ui::StaffRequest& request) override;
  void show(ui::ServiceView& view) override;

 private:
  static constexpr std::int64_t kShown = 40;  // of a page
  std::vector<ui::LogLine> wanted() const;    // newest first
  ListWalk walk_{kShown};
  std::vector<ui::LogLine> lines_;
  ui::LogView view_;
};

}  // namespace relievo::firmware
