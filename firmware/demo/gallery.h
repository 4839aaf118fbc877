// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gallery: every screen there is, each as the view and the visit that lead to it; for screenshots and
// for tests that go over all of them. Built upon one real view (of Review), which lends its pictures.
// Thread: main. Errors: none.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "firmware/kiosk/kiosk.h"
#include "ui/technician/technician_view.h"
#include "ui/ui.h"

namespace relievo::firmware {

struct Exhibit {
  std::string_view name;
  ui::ViewState view;
  ui::Visit visit;
  ui::Service service;  // closed, but for the staff's pages
  // What the view of a staff's page borrows.
  struct Lent {
    ui::TechnicianView technician;
    ui::ServiceView staff;
  };
  std::shared_ptr<Lent> lent{};
};

std::vector<Exhibit> gallery(const ui::ViewState& review, ui::Language language, std::size_t text_size,
                             bool high_contrast);

// Adds the staff's pages, behind which is the view `idle`.
struct Lender {
  std::vector<Exhibit>& exhibits;
  const ui::ViewState& idle;
  const ui::Visit& visit;
  Exhibit& add(std::string_view name, ui::StaffPage page, const ui::ServiceView& view, int mode = 0) const;
  Exhibit& add(std::string_view name, ui::StaffPage page, const ui::TechnicianView& view, int mode = 0) const;
};

// Its parts, each in a file of its own: figures that somebody made up. `review`: the view that lends pictures
// and model, which must outlive the exhibits.
void add_staff_exhibits(const Lender& all);
void add_technician_exhibits(const Lender& all, const ui::ViewState& review);

// The pictures of that stage, as far as the visitor's review has them.
void lend(const ui::ViewState& review, ui::TechnicianStage stage, ui::TechnicianView& view);

// Results beside each other, beginning with that of `view`.
void add_comparisons(const Lender& all, const ui::ViewState& review, ui::TechnicianView view);

// Screenshots: every screen in every language, size and text size, for people to look at; and one
// contact sheet for each of these. What is shown is real: the simulated rig is enrolled once.
// Files: DIR/SIZE_TEXT_LANGUAGE/NN_screen.png, beside it NN_screen.json (its nodes: role, name, place), and
// DIR/sheet_SIZE_TEXT_LANGUAGE.png; with `--showpiece`, the head for the page that invites.
// Thread: main, with a current GL context. Errors: IoFailed, MediaFull; what the enrolment says.
Result<void> take_screenshots(const KioskArgs& args, Kiosk& kiosk, Console& console);

}  // namespace relievo::firmware
