// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Action: what a touched node means. Plain data in the tree: a screen says what a button is for,
// never what happens then (visit.cc does).
#pragma once

#include <cstdint>

#include "ui/view/staff_request.h"

namespace relievo::ui {

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
  BiggerText,
  Contrast,
  Reach,
  Speech,
  Quieter,
  Louder,
  Speed,  // what is heard (ui/speech/)
  TypeKey,
  Erase,
  Shift,
  Accents,  // value: a space types one, else the node's text
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
  ShowPrivacy,
  StaffEnter,
  StaffLeave,   // the staff's side (ui/view/service.h)
  StaffOpen,    // value: a StaffPage
  StaffDo,      // what: Action::ask
  StaffAnswer,  // the same, and the page's mode is `value`, mostly 0, its first
  StaffMode,
  StaffChoose,  // value: the page's mode; a row, detail: the mode
  StaffMeasure  // touches on the model set points; again: no longer
};

struct Action {
  Action() = default;
  Action(ActionKind of_kind, std::int32_t of_value = 0, std::int32_t of_detail = 0)
      : kind(of_kind), value(of_value), detail(of_detail) {}
  // What a page asks of the appliance; `answers`: and then shows its first mode again.
  explicit Action(StaffAsk of_staff, bool answers = false)
      : kind(answers ? ActionKind::StaffAnswer : ActionKind::StaffDo), ask(of_staff) {}

  ActionKind kind = ActionKind::None;
  std::int32_t value = 0;
  std::int32_t detail = 0;
  StaffAsk ask{};
};

}  // namespace relievo::ui
