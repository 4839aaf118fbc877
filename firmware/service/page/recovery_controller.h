// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Behind the page of the recovery sheet: words are drawn when it is opened, and hold when two of them were
// typed; then it shows none again. A sheet that is left before is worth nothing. Thread: main; the store is
// written on the keeper.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "firmware/service/page_controller.h"
#include "hal/picture_file.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {

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

}  // namespace relievo::firmware
