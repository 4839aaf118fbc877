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

#include "firmware/records/event_log.h"
#include "firmware/service/export_records.h"
#include "firmware/service/side_tasks.h"
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

}  // namespace relievo::firmware
