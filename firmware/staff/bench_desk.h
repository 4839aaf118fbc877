// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BenchDesk: the workbench behind one page of the staff's side; all seven share it. Thread: main.
#pragma once

#include "firmware/bench/bench.h"
#include "firmware/service/desk_page.h"

namespace relievo::firmware {

class BenchDesk final : public DeskPage {
 public:
  BenchDesk(DeskTools& tools, Bench& bench, ui::BenchPage page)
      : DeskPage(tools), bench_(bench), page_(page) {}
  void opened() override { bench_.opened(page_); }
  void ask(const ui::StaffWish& wish) override {
    bench_.act({static_cast<ui::BenchAct>(wish.verb), wish.number});
  }
  void show(ui::ServiceView& view) override {
    view.bench = &bench_.view();
    if (page_ == ui::BenchPage::Stages || page_ == ui::BenchPage::Compare)
      view.work = {view.bench->recording.running, view.bench->recording.progress,
                   view.bench->recording.outcome};
    view.inner = page_ == ui::BenchPage::Algorithms && view.bench->choice.edited != nullptr;
  }
  void closed() override { bench_.closed(page_); }

 private:
  Bench& bench_;
  ui::BenchPage page_;
};

// One for every page on the workbench; StaffPage::Stages and those after it, in BenchPage's order.
template <typename Pages>
void fill_bench_pages(DeskTools& tools, Bench& bench, Pages& pages) {
  for (int i = 0; i <= static_cast<int>(ui::BenchPage::Calibrate); ++i)
    pages[static_cast<std::size_t>(ui::StaffPage::Stages) + static_cast<std::size_t>(i)] =
        std::make_unique<BenchDesk>(tools, bench, static_cast<ui::BenchPage>(i));
}

}  // namespace relievo::firmware
