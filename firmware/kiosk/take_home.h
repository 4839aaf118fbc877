// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TakeHome: the visitor's copy of their record on a stick of their own, where the operator offers it. It is
// what the staff's export makes of one record (service/export_records.h). The stick must have come during
// the visit: one that was there before may be the operator's, or another visitor's.
// Nothing on a stick is shown, and of what lies on it nothing is taken in.
// Thread: main; the stick is the keeper's while it writes, and nobody else asks it then: it may take long to
// answer. Errors: none: the page says how it ended.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "firmware/records/event_log.h"
#include "firmware/service/export_records.h"
#include "firmware/service/side_tasks.h"
#include "hal/device.h"
#include "hal/picture_file.h"
#include "ui/text/text_engine.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

class TakeHome {
 public:
  struct Parts {
    SideTasks& side_tasks;
    hal::RemovableMedia& media;
    storage::Store& store;
    const hal::Clock& clock;
    EventLog& log;
  };
  explicit TakeHome(const Parts& parts) : parts_(parts) {}

  // Once a turn, with the settings and view.receipt; fills in view.take_home. `visited`: somebody's visit is
  // under way.
  void follow(ui::ViewState& view, bool visited);
  void take(storage::EnrolmentId enrolment, const ui::Settings& settings);
  // Nothing half written stays; what was written as a whole does.
  void stop();

 private:
  struct Writing {
    bool ended = false;
    ui::Outcome outcome = ui::Outcome::None;
    ExportTrace trace;
  };
  bool writes() const { return writing_ != nullptr && !writing_->ended; }
  void look(bool visited);

  Parts parts_;
  std::shared_ptr<Writing> writing_;  // the last, until another visit begins
  std::uint32_t task_ = 0;            // that writes it
  hal::Instant begun_{}, looked_{};
  bool there_ = true, ours_ = false;  // is there a stick; was it plugged during this visit?
  bool given_up_ = false;             // the stick has not answered in time
  bool wrote_ = false;                // a turn ago
};

// ReceiptSlip: what a visitor takes home of their visit: the code for the erasure as a QR code on the screen,
// the link to what the operator offers as another, both on paper where there is a printer. They are there as
// long as the code is, and wiped with it: the pictures by the heap that takes them back.
// Thread: main; the printer is the keeper's. Errors: none: a slip that could not be printed is said so.

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
