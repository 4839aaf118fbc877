// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The staff's screens. Each is a function of ViewState and Service alone: it fills the tree and
// remembers nothing. Thread: main. Errors: none.
#pragma once

#include <span>

#include "ui/screens/service/staff_frame.h"

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

}  // namespace relievo::ui
