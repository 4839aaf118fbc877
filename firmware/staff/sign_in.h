// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SignIn: behind the pages on which PINs are typed: the way in, the first start, a new PIN of one's own.
// A PIN that was typed is kept only until its twin has been typed, and wiped when the page is left. What is
// found out about it after that lets nobody in and is not shown on the next page.
// Thread: main; what takes time runs as a side task on the keeper.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/records/event_log.h"
#include "firmware/service/access.h"
#include "firmware/service/consent_text_store.h"
#include "firmware/service/side_tasks.h"
#include "hal/base/wiped_text.h"
#include "ui/view/service.h"

namespace relievo::firmware {

// Sets the system's clock. Errors: Unsupported (it may not).
using SetClock = std::function<Result<void>(std::chrono::system_clock::time_point)>;

class SignIn {
 public:
  struct Parts {
    storage::Store& store;
    const hal::Clock& clock;
    SideTasks& side_tasks;
    EventLog& log;
    SetClock set_clock;
    ConsentTextStore& consent;
    bool demands_set_up = false;  // see ui::AccessView::demanded
  };
  explicit SignIn(Parts parts) : parts_(std::move(parts)), access_(parts_.store, parts_.clock) {}
  SignIn(const SignIn&) = delete;
  SignIn& operator=(const SignIn&) = delete;

  // Before any thread uses the store.
  Result<void> look();
  void ask(const ui::StaffRequest& request, ui::StaffRole role);
  void opened(ui::StaffPage page);
  // Whoever typed a right PIN since the last call.
  ui::StaffRole take_entered() { return std::exchange(entered_, ui::StaffRole::None); }
  void show(ui::AccessView& view) const;
  void forget();

 private:
  struct Pins {
    WipedText one, clerk;  // the operator's, where both are chosen
  };
  void check(std::string_view pin);
  void offer(std::string_view pin, ui::StaffRole role);
  void offered_again(std::string_view pin, ui::StaffRole role);
  void judge(std::string_view pin, ui::StaffRole role, ui::PinStep next);
  // `begins` is where who is refused begins again; `said` goes to the log.
  void save(const Pins& pins, ui::PinStep begins, std::function<Result<void>(const Pins&)> write,
            std::vector<ui::LogEvent> said);
  void refuse(const Error& error, ui::PinStep again);
  void set_clock();

  Parts parts_;
  Access access_;
  std::optional<Errc> failed_;  // why the last PIN could not be checked or kept
  bool set_up_ = false, checking_ = false, wrong_ = false, clock_right_ = false, clock_refused_ = false,
       consent_right_ = false;
  ui::StaffRole forgotten_ = ui::StaffRole::None;  // whose PIN is to be chosen anew
  std::chrono::minutes clock_moved_{0};
  ui::PinStep step_ = ui::PinStep::Technician;
  ui::PinFault fault_ = ui::PinFault::None;
  hal::Instant wait_until_{};
  WipedText first_, technician_;  // typed once; the technician's, until the operator's is there
  std::uint32_t visit_ = 0;       // of the page: what was asked before it was left is not answered after
  ui::StaffRole entered_ = ui::StaffRole::None;
  mutable std::string clock_text_;
  mutable std::chrono::sys_time<std::chrono::minutes>
      clock_text_at_{};  // made once a minute, not once a frame
};

}  // namespace relievo::firmware
