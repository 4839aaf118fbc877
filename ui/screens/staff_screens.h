// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's screens. Each is a function of ViewState and Service alone: it fills the tree and
// remembers nothing. Thread: main. Errors: none.
#pragma once

#include <array>
#include <span>

#include "ui/screens/service/staff_frame.h"
#include "ui/view/staff_views.h"

namespace relievo::ui {

// A row of the menu: one page of the staff's side.
struct StaffPageInfo {
  StaffPage page;
  std::string_view id;                // of its tile
  const char* title;                  // English, the key of its words
  const char* letter;                 // of the icon font
  bool for_technician, for_operator;  // who may open it
  void (*draw)(StaffFrame&);
  const char* group = nullptr;  // where one begins in the menu: its heading, as the title
};
std::span<const StaffPageInfo> staff_pages();
bool may_open(StaffRole role, const StaffPageInfo& info);

// The page of this moment, with what lies over it; view.service is not null. Returns its palette.
const Palette& build_staff_screen(Tree& tree, const ViewState& view, const Visit& visit,
                                  const Service& service, const Rect& screen);
// The pictures and the model that it shows.
void fill_staff_pictures(DrawList& list, const ViewState& view, const Visit& visit, const Service& service);
// The way in, over the pages of the visitor that have one.
void staff_entrance(Page& page);

void menu_page(StaffFrame& page);

// What needs a hand: a rule each, with its words and the page on which it is mended. The staff's first page
// begins with those that fire, worst first. A new rule is a row of status_rules(); what it must know and the
// pages do not know yet is a field of StatusView.
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
