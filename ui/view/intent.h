// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Intent: what a person at the screen asks for. The machine decides whether it listens.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace relievo::ui {

enum class Intent : std::uint8_t {
  LookUp,  // is there a record of the name, or of the code, that was typed? (Appliance::ask_records)
  Pose,    // stand before the cameras: the live picture begins (a person who has agreed, with a name)
  Begin,   // take the picture
  Enough,  // no more sides of the head are taken
  Accept,
  Print,  // the code for the erasure, on paper
  Retake,
  Cancel,
  StillHere,  // somebody is there: a state that waits for a person waits longer
  OpenStaff,
  LeaveStaff,
  Calibrate,
  Export
};

// What is to become of the portrait.
enum class EnrolmentKind : std::uint8_t {
  NewSubject,  // of somebody new
  Renewal,     // in the place of the earlier ones of the record whose code was quoted
  Addition     // beside them
};

// Who stands there, and what they have agreed to; goes with Intent::LookUp and Intent::Pose. Borrowed for the
// call.
struct VisitRequest {
  std::string_view name;
  std::string_view wording;   // which consent text was shown
  std::string_view language;  // in which language, BCP 47
  std::chrono::system_clock::time_point agreed_at;
  bool quotes_code = false;  // the name is the code of an earlier record, or nothing
  EnrolmentKind enrolment_kind = EnrolmentKind::NewSubject;
};

}  // namespace relievo::ui
