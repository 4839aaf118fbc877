// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffController: the appliance's half of the staff's side. It signs in who has a PIN, keeps the pages'
// controllers, and closes everything when they go, or when nobody has touched the screen for long.
//
//   ask(StaffRequest), touched(), turn() --> view()
//
// The machine's state Staff (with Calibrate and Export beyond it) is the only one in which a role
// holds. Thread: main. Errors of open(): the store's.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/base/console.h"
#include "firmware/service/access.h"
#include "firmware/service/consent_text_store.h"
#include "firmware/service/device_settings.h"
#include "firmware/service/page_controller.h"
#include "firmware/service/statistics.h"
#include "firmware/service/touch_trial.h"
#include "firmware/technician/test_capture.h"
#include "hal/base/wiped_text.h"
#include "ui/view/service.h"

namespace relievo::firmware {

// Sets the system's clock. Errors: Unsupported (it may not).
using SetClock = std::function<Result<void>(std::chrono::system_clock::time_point)>;

// SignIn: behind the pages on which PINs are typed: the way in, the first start, a new PIN of one's own.
// A PIN that was typed is kept only until its twin has been typed, and wiped when the page is left. What is
// found out about it after that lets nobody in and is not shown on the next page.
// Thread: main; what takes time runs as a side task on the keeper.
class SignIn {
 public:
  SignIn(PageServices& services, SetClock set_clock)
      : services_(services),
        set_clock_(std::move(set_clock)),
        access_(services.store, services.device.clock()) {}
  SignIn& operator=(SignIn&&) = delete;

  // Before any thread uses the store.
  Result<void> look();
  void ask(const ui::StaffRequest& request, ui::StaffRole role);
  void opened(ui::StaffPage page);
  // Whoever typed a right PIN since the last call.
  ui::StaffRole take_entered() { return std::exchange(entered_, ui::StaffRole::None); }
  // Whether somebody has said since the last call that the clock, as it was or as they set it, is right.
  bool take_clock_confirmed() { return std::exchange(clock_confirmed_, false); }
  void show(ui::AccessView& view) const;
  void forget();

 private:
  struct Pins {
    WipedText one, operators;  // the second where both are chosen
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
  void confirm_clock();
  void settle_in(ui::Language home);

  PageServices& services_;
  SetClock set_clock_;
  Access access_;
  ui::AccessView view_;                            // without what time changes (show())
  ui::StaffRole forgotten_ = ui::StaffRole::None;  // whose PIN is to be chosen anew
  std::chrono::minutes clock_moved_{0};
  bool clock_confirmed_ = false;
  std::optional<ui::Language> home_;  // of the device, until both PINs are chosen
  hal::Instant wait_until_{};
  WipedText first_, technician_;  // typed once; the technician's, until the operator's is there
  std::uint32_t visit_ = 0;       // of the page: what was asked before it was left is not answered after
  ui::StaffRole entered_ = ui::StaffRole::None;
  mutable std::string clock_text_;
  mutable std::chrono::sys_time<std::chrono::minutes>
      clock_text_at_{};  // made once a minute, not once a frame
};

class StaffController {
 public:
  struct Parts {
    Appliance& appliance;
    hal::Device& device;
    storage::Store& store;
    std::filesystem::path folder;      // of the store: for the log's file and the disk's room
    const std::uint32_t& calibration;  // the revision that is measured with, 0 for none
    SetClock set_clock;
    Console& console;  // for whoever administers the machine: why it cannot work
  };
  // Before a thread uses the store.
  static Result<std::unique_ptr<StaffController>> open(Parts parts);
  ~StaffController();
  StaffController& operator=(StaffController&&) = delete;

  // The technician's picture pages. Once, before anybody signs in.
  void set_test_capture(std::unique_ptr<TestCapture> test_capture);
  SideTasks& side_tasks() { return side_tasks_; }
  const SideTasks& side_tasks() const { return side_tasks_; }

  void ask(const ui::StaffRequest& request);
  void touched();
  // Once every turn of the main loop, after the appliance's.
  void turn();
  bool take_clock_confirmed() { return sign_in_.take_clock_confirmed(); }
  // What it says when it begins to be wrong is told once, against the newest record that came in.
  void clock_is(bool right, storage::WallTime newest_record);
  // Valid until the next turn().
  const ui::ServiceView& view();

  EventLog& log() { return log_; }
  const EventLog& log() const { return log_; }
  const ui::Settings& settings() const { return settings_.now(); }
  TouchTrial& touch() { return touch_; }
  ConsentTextStore& consent() { return consent_; }

 private:
  explicit StaffController(Parts parts);
  void let_in();
  void leave();
  void close_page();
  void noted(const Transition& change);
  void note_fault(const Transition& change, const Error& problem);
  void save_what_changed();
  bool inside() const { return role_ != ui::StaffRole::None; }
  int seconds_left() const;

  Parts parts_;
  EventLog log_;
  SideTasks side_tasks_;
  Statistics statistics_;
  VisitCosts costs_;
  DeviceSettings settings_;
  RetentionWatch retention_;
  TouchTrial touch_;
  ConsentTextStore consent_;
  PageServices services_;
  SignIn sign_in_;
  std::array<std::unique_ptr<PageController>, std::size_t(ui::StaffPage::Count)> pages_;
  std::unique_ptr<TestCapture> test_capture_;
  PageController* page_ = nullptr;
  ui::StaffRole role_ = ui::StaffRole::None, waiting_ = ui::StaffRole::None;
  bool turned_ = false;  // the kiosk has begun to serve
  bool clock_right_ = true;
  hal::Instant last_touch_{};
  float kept_ = 0;              // of the keeper's work, a turn ago
  std::optional<Error> fault_;  // why it does not work, until it does again
  ui::ServiceView view_;
};

}  // namespace relievo::firmware
