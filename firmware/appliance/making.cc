// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of Appliance that says how far a portrait is, and gives one up, but never what is being stored.
#include "firmware/appliance/appliance.h"

namespace relievo::firmware {

void Appliance::look_at_progress() {
  const hal::Instant now = device_.clock().now();
  const State state = machine_.state();
  if (is_stage(state)) making_.works_on(number_of(state), now);
  else if (state == State::Turn || state == State::Fuse) making_.works_on(head_.parts_done(), now);
  else if (state == State::Review || state == State::Store) making_.done();
  else making_.begin();
}

std::size_t Appliance::parts_done() const { return head_.parts_done(); }

// What has begun to be stored is stored whole or not at all: the visitor is told which, whatever would end
// the state.
void Appliance::await_commit() {
  if (machine_.state() != State::Store || job_ == 0) return;
  keeper_.cancel();
  keeper_.wait_until_idle();
  while (const auto report = reports_.take_for(std::chrono::milliseconds(0))) heard(*report);
}

void Appliance::give_up(const Error& error) {
  await_commit();
  if (!session_.is_open()) return;  // it was stored
  note(error);
  handle(Event::Failed);
}

}  // namespace relievo::firmware
