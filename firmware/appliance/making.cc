// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Appliance's way from the photograph to the portrait: which part of it each state works on.
#include "firmware/appliance/appliance.h"

namespace relievo::firmware {

void Appliance::look_at_progress() {
  const hal::Instant now = device_.clock().now();
  switch (machine_.state()) {
    case State::Match:
    case State::Reconstruct:
    case State::Mesh:
    case State::Texture:
    case State::Assemble:
      return making_.works_on(number_of(machine_.state()), now);
    case State::Turn:
    case State::Fuse:
      return making_.works_on(head_.parts_done(), now);
    case State::Review:
    case State::Store:
      return making_.done();
    case State::SelfTest:
    case State::Idle:
    case State::Calibrate:
    case State::Position:
    case State::Capture:
    case State::Export:
    case State::Staff:
    case State::Fault:
    case State::Count:
      break;
  }
  making_.begin();
}

}  // namespace relievo::firmware
