// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BusyLane: a thread of the side tasks that is busy with something else of the device until it goes.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "firmware/service/side_tasks.h"

namespace relievo::firmware {

class BusyLane {
 public:
  BusyLane(SideTasks& side_tasks, JobLane lane) {
    side_tasks.send(
        lane,
        [state = state_](JobControl& control) -> Result<void> {
          state->held.wait(true);
          state->stopped = control.cancelled.load();
          return {};
        },
        [](const std::optional<Error>&) {}, SideTasks::Whose::Device);
  }
  ~BusyLane() { go_on(); }
  BusyLane(const BusyLane&) = delete;
  BusyLane& operator=(const BusyLane&) = delete;

  void go_on() {
    state_->held = false;
    state_->held.notify_all();
  }
  // Whether somebody had stopped it; once the lane is free again.
  bool stopped() const { return state_->stopped; }

 private:
  struct State {
    std::atomic<bool> held{true}, stopped{false};
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace relievo::firmware
