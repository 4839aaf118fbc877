// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of records: search, show, erase, export, on the store. Every name it has read is given back
// to the heap when the page is left, which wipes it (base/wiping_heap.cc). Thread: main; the store's work
// runs on the keeper.
#pragma once

#include <functional>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <vector>

#include "firmware/base/list_walk.h"
#include "firmware/service/export_records.h"
#include "firmware/service/page_controller.h"
#include "firmware/service/record_filter.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

class RecordsController final : public PageController {
 public:
  using PageController::PageController;
  ~RecordsController() override { forget(); }
  void opened() override;
  void ask(const ui::StaffRequest& request) override;
  void show(ui::ServiceView& view) override;
  void closed() override;

 private:
  static constexpr std::int64_t kPage = 50;
  struct Person {
    ui::RecordRow found;
    std::string consent, consented_at;
    std::pmr::monotonic_buffer_resource memory;
    std::optional<pipeline::FaceModel> model;
  };
  // On the keeper; `found` only if it went well and the page is still the same.
  void look(SideTasks::Work work, std::function<void()> found);
  void search(std::string_view text);
  void list();
  void label_stretches();
  void choose(std::size_t filter);
  void find_filters();
  void load(std::int64_t number);
  void erase(std::int64_t number);
  void take_out(std::int64_t number);
  void exported(const std::optional<Error>& error, const ExportTrace& trace);
  void told(const std::optional<Error>& error);
  void forget();

  std::uint32_t visit_ = 0;  // of the page: what was asked before it was left is not shown after
  RecordChoice choice_;
  ListWalk walk_{kPage};
  std::uint32_t division_ = 0;  // of the stretches: what was found for those before is not shown
  std::vector<ui::RecordFilter> filters_;
  int looks_ = 0;  // under way
  hal::Instant looks_since_{};
  bool ready_ = false, erased_ = false, exporting_ = false, exported_ = false;
  std::vector<ui::RecordRow> found_;
  std::shared_ptr<Person> person_;
  std::uint32_t model_number_ = 0;
  ui::Outcome outcome_ = ui::Outcome::None;
  std::uint32_t export_ = 0;  // the last one's side task
  ExportTrace trace_;         // and how far it came
  ui::RecordsView view_;
};

}  // namespace relievo::firmware
