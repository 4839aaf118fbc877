// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What needs a hand: a rule each, with its words and the page on which it is mended. The staff's first page
// begins with those that fire, worst first. A new rule is a row of status_rules(); what it must know and the
// pages do not know yet is a field of StatusView. Thread: main. Errors: none.
#pragma once

#include <array>
#include <span>

#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {

struct StatusRule {
  std::string_view id;
  const char* words;                       // English, the key of its words
  StaffPage for_technician, for_operator;  // where either role mends it; Menu: that is the other's work
  Mood (*mood)(const ViewState&, const StatusView&);                    // Plain: nothing is wrong
  std::string_view (*value)(StaffFrame&, const StatusView&) = nullptr;  // may be missing
  StaffPage page_of(StaffRole role) const {
    return role == StaffRole::Operator ? for_operator : for_technician;
  }
};
std::span<const StatusRule> status_rules();

inline constexpr std::size_t kMostFindings = 20;
struct Finding {
  const StatusRule* rule = nullptr;
  Mood mood = Mood::Plain;
};
// Those that fire, worst first. A span of `found`.
std::span<const Finding> find_status(const ViewState& view, const StatusView& status,
                                     std::array<Finding, kMostFindings>& found);

}  // namespace relievo::ui
