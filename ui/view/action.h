// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Action: what a touched node means. Plain data in the tree: a screen says what a button is for,
// never what happens then (visit.cc does).
#pragma once

#include <cstdint>

namespace relievo::ui {

enum class ActionKind : std::uint8_t {
  None,
  Start,
  Agree,
  Decline,
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
  TypeKey,
  Erase,
  Shift,
  Accents,  // value: a space types one, else the node's text
  TakePicture,
  Accept,
  Retake,
  TurnFace,  // dragged
  TurnLeft,
  TurnRight,
  ZoomIn,
  ZoomOut,
  MoveLight,
  ShowShape,
  LookPoints,
  LookEdges,
  LookFill,
  LookLight,  // what of the model is drawn
  HaveCode,
  SomebodyElse,
  Renew,
  AddAnother,  // already enrolled
  Finish,
  StaffEnter,
  StaffLeave,   // the staff's side (ui/view/service.h)
  StaffOpen,    // value: a StaffPage
  StaffDo,      // value: one of the page's verbs, detail: its number
  StaffAnswer,  // the same, and the page's mode is its first again
  StaffMode,
  StaffChoose  // value: the page's mode; a row, detail: the mode
};

struct Action {
  ActionKind kind = ActionKind::None;
  std::int32_t value = 0;
  std::int32_t detail = 0;
  bool operator==(const Action&) const = default;
};

}  // namespace relievo::ui
