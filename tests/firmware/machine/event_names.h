// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests call the machine's events when they say which one failed.
#pragma once

#include <array>
#include <string_view>

#include "firmware/machine/machine.h"

namespace relievo::firmware {

// In the order of Event.
inline constexpr std::array<std::string_view, std::size_t(Event::Count)> kEventNames{
    "Passed",    "Failed",      "PoseAsked",   "Begin",          "Triggered",  "TurnAsked",
    "StageDone", "StageFailed", "AdviceGiven", "Accept",         "Retake",     "Cancel",
    "Timeout",   "StaffIn",     "StaffOut",    "CalibrateAsked", "ExportAsked"};
static_assert(!kEventNames.back().empty());

inline std::string_view name_of(Event event) {
  return event < Event::Count ? kEventNames[std::size_t(event)] : "?";
}

}  // namespace relievo::firmware
