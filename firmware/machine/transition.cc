// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/machine/transition.h"

namespace relievo::firmware {
namespace {

// In the order of State.
constexpr std::array<std::string_view, static_cast<std::size_t>(State::Count)> kStateNames{
    "SelfTest", "Idle",     "Calibrate", "Position", "Capture", "Turn",   "Match", "Reconstruct", "Mesh",
    "Texture",  "Assemble", "Fuse",      "Review",   "Store",   "Export", "Staff", "Fault"};
static_assert(!kStateNames.back().empty());

// In the order of Event.
constexpr std::array<std::string_view, static_cast<std::size_t>(Event::Count)> kEventNames{
    "Passed",    "Failed",      "PoseAsked",   "Begin",          "Triggered",  "TurnAsked",
    "StageDone", "StageFailed", "AdviceGiven", "Accept",         "Retake",     "Cancel",
    "Timeout",   "StaffIn",     "StaffOut",    "CalibrateAsked", "ExportAsked"};
static_assert(!kEventNames.back().empty());

template <typename Enum>
std::string_view name_in(const auto& names, Enum which) {
  return which < Enum::Count ? names[static_cast<std::size_t>(which)] : "?";
}

}  // namespace

std::string_view name_of(State state) { return name_in(kStateNames, state); }

std::string_view name_of(Event event) { return name_in(kEventNames, event); }

}  // namespace relievo::firmware
