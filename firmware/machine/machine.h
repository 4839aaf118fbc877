// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Machine: the present state, and how long it may last. It knows the table and the clock, and does
// nothing else: what a change of state sets in motion, the Appliance decides.
// Thread: main. Errors: none; an event a state does not listen to changes nothing.
#pragma once

#include <chrono>
#include <optional>

#include "firmware/machine/transition.h"
#include "hal/clock.h"

namespace relievo::firmware {

struct Change {
  State from;
  Event event;
  State to;
};

// How long a state may last; nothing where it may last for ever.
std::optional<std::chrono::milliseconds> limit_of(State state);

class Machine {
 public:
  explicit Machine(hal::Instant now) : entered_(now) {}

  State state() const { return state_; }
  hal::Instant entered() const { return entered_; }

  // Entering a state, also the same one again, starts its time anew.
  std::optional<Change> handle(Event event, hal::Instant now);
  // Somebody is there: a state that waits for a person waits its whole time again.
  void renew(hal::Instant now);
  // Handles Timeout when the state's time is over.
  std::optional<Change> tick(hal::Instant now);

 private:
  State state_ = State::SelfTest;
  hal::Instant entered_;
};

}  // namespace relievo::firmware
