// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ReceiptSlip: what a visitor takes home of their visit: the code for the erasure as a QR code on the screen,
// the link to what the operator offers as another, both on paper where there is a printer. They are there as
// long as the code is, and wiped with it: the pictures by the heap that takes them back.
// Thread: main; the printer is the keeper's. Errors: none: a slip that could not be printed is said so.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "firmware/service/side_tasks.h"
#include "hal/device.h"
#include "hal/picture_file.h"
#include "ui/text/text_engine.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

// The slip of 80 mm at 8 dots a mm: whose it is, the code as QR and in digits, what it is for; the link.
hal::Picture draw_slip(ui::TextEngine& text, ui::Language language, const ui::ViewState& view);

class ReceiptSlip {
 public:
  // `printer` may be empty.
  ReceiptSlip(SideTasks& side_tasks, std::shared_ptr<hal::Printer> printer)
      : side_tasks_(side_tasks), printer_(std::move(printer)) {}
  ~ReceiptSlip() { wipe(); }
  ReceiptSlip& operator=(ReceiptSlip&&) = delete;

  // view.receipt, once a frame; fills in what a screen may show of it. `number`: of the link.
  void follow(ui::ViewState& view, std::string_view number);
  void print(ui::TextEngine& text, ui::Language language, const ui::ViewState& view);

 private:
  void wipe();
  void ask_printer();

  SideTasks& side_tasks_;
  std::shared_ptr<hal::Printer> printer_;
  std::string receipt_, link_;
  hal::Picture code_, link_code_;
  std::uint32_t number_ = 0;  // of the code: what a printer says of another is no news
  std::shared_ptr<ui::Printing> printing_ = std::make_shared<ui::Printing>(ui::Printing::None);
};

}  // namespace relievo::firmware
