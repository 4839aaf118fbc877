// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the technician's tests: SelfTestDesk asks memory, store, calibration, disk and cameras;
// TriggerDesk pulses the line and counts what both cameras saw; LogDesk shows the newest lines.
// The store is read on the keeper, cameras are asked on the capture thread; the pictures of a test are
// wiped before it is reported. Thread: main.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "firmware/service/desk_page.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

class SelfTestDesk final : public DeskPage {
 public:
  using DeskPage::DeskPage;
  void opened() override;
  void ask(const ui::StaffWish& wish) override;
  void show(ui::ServiceView& view) override;
  void closed() override { ++visit_; }

 private:
  void begin(ui::Check check, JobPlace place, Errands::Work work);
  std::uint32_t visit_ = 0;
  int running_ = 0;
  ui::SelfTestView view_;
};

class TriggerDesk final : public DeskPage {
 public:
  using DeskPage::DeskPage;
  void opened() override;
  void ask(const ui::StaffWish& wish) override;
  void show(ui::ServiceView& view) override;
  void closed() override;

 private:
  static constexpr int kPulses = 10;
  std::uint32_t visit_ = 0;
  bool running_ = false;
  ui::TriggerView view_;
};

class LogDesk final : public DeskPage {
 public:
  using DeskPage::DeskPage;
  void show(ui::ServiceView& view) override;

 private:
  static constexpr std::size_t kShown = 60;
  std::vector<LogEntry> lines_;
  std::vector<ui::LogLine> shown_;
  ui::LogView view_;
};

}  // namespace relievo::firmware
