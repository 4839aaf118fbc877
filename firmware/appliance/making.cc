// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of Appliance that says how far a portrait is, and gives one up.
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

void Appliance::give_up(const Error& error) {
  await_commit();
  if (!session_.is_open()) return;  // it was stored
  note(error);
  handle(Event::Failed);
}

}  // namespace relievo::firmware
