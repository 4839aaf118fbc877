// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the technician's pages are shown in the gallery, for its files. Thread: main. Errors: none.
#pragma once

#include <deque>
#include <string_view>

#include "firmware/demo/gallery.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

struct Lent {
  std::string_view name;
  ui::StaffPage page;
  ui::TechnicianView view;
  ui::ServiceView staff;
  ui::Fault note;  // said against the calibration
  bool edges = false;
  int mode = 0;
  bool measures = false;
};

// All that is lent to the pages, for as long as they are looked at.
struct Lender {
  std::deque<Lent> lent;
  void add(std::string_view name, ui::StaffPage page, const ui::TechnicianView& view) {
    lent.push_back({name, page, view, {}, {}, false, 0, false});
  }
};

// The pictures of that stage, as far as the visitor's review has them.
void lend(const ui::ViewState& review, ui::TechnicianStage stage, ui::TechnicianView& view);

// Results beside each other, beginning with that of `view`.
void add_comparisons(Lender& all, const ui::ViewState& review, ui::TechnicianView view);

}  // namespace relievo::firmware
