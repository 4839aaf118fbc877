// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/machine/transition.h"

namespace relievo::firmware {

std::string_view name_of(State state) {
  switch (state) {
    case State::SelfTest:
      return "SelfTest";
    case State::Idle:
      return "Idle";
    case State::Calibrate:
      return "Calibrate";
    case State::Position:
      return "Position";
    case State::Capture:
      return "Capture";
    case State::Turn:
      return "Turn";
    case State::Match:
      return "Match";
    case State::Reconstruct:
      return "Reconstruct";
    case State::Mesh:
      return "Mesh";
    case State::Texture:
      return "Texture";
    case State::Assemble:
      return "Assemble";
    case State::Fuse:
      return "Fuse";
    case State::Review:
      return "Review";
    case State::Store:
      return "Store";
    case State::Export:
      return "Export";
    case State::Staff:
      return "Staff";
    case State::Fault:
      return "Fault";
    case State::Count:
      break;
  }
  return "?";
}

std::string_view name_of(Event event) {
  switch (event) {
    case Event::Passed:
      return "Passed";
    case Event::Failed:
      return "Failed";
    case Event::PoseAsked:
      return "PoseAsked";
    case Event::Begin:
      return "Begin";
    case Event::Triggered:
      return "Triggered";
    case Event::TurnAsked:
      return "TurnAsked";
    case Event::StageDone:
      return "StageDone";
    case Event::StageFailed:
      return "StageFailed";
    case Event::AdviceGiven:
      return "AdviceGiven";
    case Event::Accept:
      return "Accept";
    case Event::Retake:
      return "Retake";
    case Event::Cancel:
      return "Cancel";
    case Event::Timeout:
      return "Timeout";
    case Event::StaffIn:
      return "StaffIn";
    case Event::StaffOut:
      return "StaffOut";
    case Event::CalibrateAsked:
      return "CalibrateAsked";
    case Event::ExportAsked:
      return "ExportAsked";
    case Event::Count:
      break;
  }
  return "?";
}

}  // namespace relievo::firmware
