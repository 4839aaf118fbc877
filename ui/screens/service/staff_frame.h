// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffFrame: what every page of the staff's side is built with: a Page, and the widgets that rows of
// figures need. Targets are 56 dp high or more (a visitor's are larger). Lengths that go in are dp.
// Thread: main. Errors: none.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "ui/screens/parts/page.h"
#include "ui/screens/service/plot.h"
#include "ui/view/service.h"
#include "ui/view/service_view.h"

namespace relievo::ui {

namespace size {
inline constexpr float kStaffTarget = 60;
inline constexpr ButtonSize kStaffButton{kStaffTarget, kStaffTarget, 20, 8, 10, 18, 26, type::kSmall};
}  // namespace size

// A sentence in English, the key of its words.
struct Told {
  const char* words;
  Mood mood = Mood::Bad;
};

// Of one text for each value of an enumeration, in its order.
template <std::size_t kCount, typename Which>
const char* one_of(const Words& tr, const std::array<const char*, kCount>& english, Which which) {
  return tr(english[std::size_t(which)]);
}

class StaffFrame : public Page {
 public:
  static constexpr float kMostTextShare = 1.5F;  // rows of figures have no room for more
  StaffFrame(Tree& tree_in, const ViewState& view_in, const Visit& visit_in, const Service& service_in,
             const Palette& palette_in, const Rect& screen)
      : Page(tree_in, view_in, visit_in, palette_in, screen), service(service_in), staff(*view_in.service) {
    text_share = std::min(text_share, kMostTextShare);
    text_sizes = std::size_t(std::ranges::count_if(
        kTextPercents, [](int percent) { return float(percent) <= 100 * kMostTextShare; }));
  }

  const Service& service;
  const ServiceView& staff;

  // The frame of every page: bar with the way back, title, room for the rest. Closed by end().
  void begin(const char* title, const char* letter);
  void end() { tree.close(); }

  // A card whose rows can be scrolled. A list has the room that is left and ends with its last row; a panel,
  // which stands beside pictures, fills its room. Closed by Tree::close().
  void begin_list(std::string_view id) { begin_card(id, true); }
  void begin_panel(std::string_view id) { begin_card(id, false); }
  // Label at the start, value at the end; with an action it can be touched.
  void row(std::string_view id, std::string_view label, std::string_view value, Mood mood = Mood::Plain,
           Action action = {});
  // Label, then less, the value, more; an end has no action. Ids: "ID less", "ID more".
  void stepper(std::string_view id, std::string_view label, std::string_view value, Action less, Action more);
  // What is being typed; before the first letter, what is asked. `done`: of the key that ends it, Enter does
  // the same.
  void typed_field(std::string_view id, std::string_view asked, const Action& done);
  // A series of values, as a row of a card.
  void plot(const Plot& what);
  // A heading between rows.
  void section(std::string_view words);
  // In the middle of a card that has no rows.
  void nothing(std::string_view id, const char* letter, std::string_view words);
  void rule();  // a thin line between rows
  // A line over the whole width.
  void line(std::string_view words, Mood mood = Mood::Plain);
  // A line of the log, in the reader's language.
  void logged(const struct LogLine& what);
  // What the engine says in English, as it wrote it: quieter, and from left to right in every language.
  Node english(std::string_view words, float size) const;
  // The same on lines of its own: the detail of what stands above it.
  void detail(std::string_view words);
  // As high as a member of staff needs it.
  void small_button(std::string_view id, std::string_view label, const char* letter, ButtonLook look,
                    Action action, float grow = 0) {
    button(id, label, letter, look, action, grow, size::kStaffButton);
  }
  // One sentence with the sign of its mood.
  void status(std::string_view id, std::string_view words, Mood mood);
  // How the page's work ended, with a sign; nothing where nothing has.
  void outcome() { outcome(staff.work.outcome); }
  void outcome(Outcome how);
  // A name made of two parts, kept for the frame: "stage 3".
  std::string_view id(std::string_view what, std::size_t number) const;
  // "12.5 mm", "90.0°", with the language's decimal mark and digits in threes, kept apart from the direction
  // of the words around.
  template <typename Number>
  std::string_view number(Number value, int decimals = 0, const char* unit_name = "") {
    return written(double(value), decimals, unit_name);
  }
  // What is a number with a point, behind it perhaps a unit, with the language's decimal mark; else as it is.
  std::string_view as_number(std::string_view text);
  // The same of every number in a text, between blanks.
  std::string_view with_numbers(std::string_view text);
  // "2026-03-14 09:12", as the language has it; what does not begin with a date, as it is.
  std::string_view date(std::string_view iso);
  Colour ink_of(Mood mood) const;
  const char* sign_of(Mood mood) const;

 private:
  std::string_view written(double value, int decimals, const char* unit_name);
  std::string_view noted(const struct LogLine& what);
  bool rule_due_ = false;  // a row stands above what comes next
  void due_rule();
  void begin_card(std::string_view id, bool fit_content);
  void leaving();
  void step_button(std::string_view id, const char* end, const char* spoken, std::string_view label,
                   const char* letter, Action action);
};

// What every list of more than a page has: first, back, where one is, on, last, and its filters. "Where one
// is" opens the ways to another place: ten stretches of the list, each with what stands at its top (a date, a
// number); one that is touched is divided again, down to a page. Thread: main. Errors: none.
using ListFilters = std::span<const std::string_view>;  // names; the first one lets all rows pass

// In place of a page whose list is jumped in or filtered; false: it is not, nothing was drawn.
bool list_choice(StaffFrame& page, const ListPlace& place, ListFilters filters = {});
// Under a list; nothing where it has one page and no filters.
void list_pager(StaffFrame& page, const ListPlace& place, ListFilters filters = {});

// The pages of the staff, one function each (ui/screens/staff_screens.h has their table).
// Thread: main. Errors: none.
void pin_page(StaffFrame& page);
void first_start_page(StaffFrame& page);
void records_page(StaffFrame& page);
void statistics_page(StaffFrame& page);
void self_test_page(StaffFrame& page);
void trigger_page(StaffFrame& page);
void log_page(StaffFrame& page);
void health_page(StaffFrame& page);
void settings_page(StaffFrame& page);
void recovery_page(StaffFrame& page);
// Which consent text is in force, how another comes from a stick, how the last try ended; then the button
// that asks for it. Also a step of the first start.
void consent_in_force(StaffFrame& page);
void clock_page(StaffFrame& page);
void touch_page(StaffFrame& page);
void pins_page(StaffFrame& page);

}  // namespace relievo::ui
