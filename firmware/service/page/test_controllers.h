// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the technician's tests: SelfTestController asks memory, store, calibration, disk and cameras;
// TriggerController pulses the line and counts what both cameras saw; LogController shows the lines of the
// log, the newest first. The store is read on the keeper, cameras are asked on the capture thread; the
// pictures of a test are wiped before it is reported. Thread: main.
#pragma once

#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/service/page_controller.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

class SelfTestController final : public PageController {
 public:
  using PageController::PageController;
  void opened() override;
  void ask(const ui::StaffRequest& request) override;
  void show(ui::ServiceView& view) override;
  void closed() override { ++visit_; }

 private:
  void begin(ui::Check check, JobLane lane, SideTasks::Work work);
  std::uint32_t visit_ = 0;
  int running_ = 0;
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
  bool running_ = false;
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
  std::vector<LogEntry> wanted() const;       // newest first
  ListWalk walk_{kShown};
  std::vector<LogEntry> lines_;
  std::vector<ui::LogLine> shown_;
  ui::LogView view_;
};

}  // namespace relievo::firmware
