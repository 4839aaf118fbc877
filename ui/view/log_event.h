// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the event log notes beside faults. Its file keeps the numbers: new ones stand at the end.
#pragma once

#include <cstdint>

namespace relievo::ui {

enum class LogEvent : std::uint8_t {
  Started,
  SignedOut,
  TechnicianSignedIn,
  OperatorSignedIn,
  WrongPin,
  ClockSet,
  TechnicianPinChosen,
  OperatorPinChosen,
  TechnicianPinForgotten,  // by the command line
  OperatorPinForgotten,
  TouchPlain,
  TouchCorrected,
  SettingChanged,   // its key and its value in figures
  RecordsExported,  // how many
  RecordsExpired,   // how many
  RecordErased,     // its number
  SelfTestBegun,
  ConsentTaken,    // its version
  SettingUnknown,  // what is stored in place of one
  Count
};

}  // namespace relievo::ui
