// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TechnicianController: behind one of the technician's seven picture pages, which share one TestCapture.
// Thread: main.
#pragma once

#include "firmware/service/page_controller.h"
#include "firmware/technician/test_capture.h"

namespace relievo::firmware {

class TechnicianController final : public PageController {
 public:
  TechnicianController(PageServices& services, TestCapture& test_capture, ui::TechnicianPage page)
      : PageController(services), test_capture_(test_capture), page_(page) {}
  void opened() override { test_capture_.opened(page_); }
  void ask(const ui::StaffRequest& request) override {
    if (const auto* asked = request.as<ui::TechnicianRequest>()) test_capture_.act(*asked);
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

// One for every picture page: StaffPage::Stages and those after it, in TechnicianPage's order.
template <typename Pages>
void fill_technician_pages(PageServices& services, TestCapture& test_capture, Pages& pages) {
  for (int i = 0; i <= static_cast<int>(ui::TechnicianPage::Calibrate); ++i)
    pages[static_cast<std::size_t>(ui::StaffPage::Stages) + static_cast<std::size_t>(i)] =
        std::make_unique<TechnicianController>(services, test_capture, static_cast<ui::TechnicianPage>(i));
}

}  // namespace relievo::firmware
