// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Action: what a touched node means. Plain data in the tree: a screen says what a button is for,
// never what happens then (visit.cc does).
#pragma once

#include <chrono>
#include <concepts>
#include <cstdint>
#include <string_view>

#include "ui/view/staff_request.h"

namespace relievo::ui {

// Intent: what a person at the screen asks for. The machine decides whether it listens.
enum class Intent : std::uint8_t {
  LookUp,  // is there a record of the name, or of the code, that was typed? (Appliance::ask_records)
  Pose,    // stand before the cameras: the live picture begins (a person who has agreed, with a name)
  Begin,   // take the picture
  Enough,  // no more sides of the head are taken
  Accept,
  Print,     // the code for the erasure, on paper
  TakeHome,  // the model, on the visitor's stick
  StopTaking,
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

enum class ActionKind : std::uint8_t {
  None,
  Start,
  Agree,
  Decline,
  ReadOn,
  Done,  // on along the path
  Back,
  Leave,
  LeaveNow,
  Stay,  // and off it
  ShowLanguages,
  ChooseLanguage,
  ShowHelp,
  CloseOverlay,
  BiggerText,  // value: of so many sizes, the smallest first; 0: of all
  Contrast,
  Reach,
  Speech,
  Quieter,
  Louder,
  Speed,    // what is heard (ui/speech/)
  TypeKey,  // value: a space types one, else the node's text
  Erase,
  Shift,
  OtherLetters,  // with accents, or Latin ones instead of another script's
  TakePicture,
  EnoughSides,
  Accept,
  Retake,
  TurnFace,  // dragged
  TurnLeft,
  TurnRight,
  ZoomIn,
  ZoomOut,
  MoveLight,
  ShowShape,
  LookAtFirst,
  LookPoints,
  LookEdges,
  LookFill,
  LookLight,  // what of the model is drawn
  HaveCode,
  LostCode,
  SomebodyElse,
  Renew,
  AddAnother,  // already enrolled
  Finish,
  Print,
  TakeHome,
  StopTaking,
  ShowPrivacy,
  StaffEnter,
  StaffLeave,   // the staff's side (ui/view/service.h)
  StaffOpen,    // value: a StaffPage
  StaffDo,      // what: Action::ask
  StaffAnswer,  // the same, and the page's mode is `value`, mostly 0, its first
  StaffMode,    // value: the page's mode
  StaffMeasure  // touches on the model set points; again: no longer
};

struct Action {
  Action() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): `{ActionKind::Back}` is an action.
  Action(ActionKind of_kind, std::int32_t of_value = 0) : kind(of_kind), value(of_value) {}
  // What a page asks of the appliance; `answers`: and then shows its first mode again.
  // NOLINTNEXTLINE(google-explicit-constructor): `ShowRecord{7}` is an action, too.
  Action(const std::convertible_to<StaffAsk> auto& of_staff, bool answers = false)
      : kind(answers ? ActionKind::StaffAnswer : ActionKind::StaffDo), ask(of_staff) {}

  ActionKind kind = ActionKind::None;
  std::int32_t value = 0;
  StaffAsk ask{};
};

}  // namespace relievo::ui
