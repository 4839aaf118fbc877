// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StaffFrame: what every page of the staff's side is built with: a Page, and the widgets that rows of
// figures need. Targets are 56 dp high or more (a visitor's are larger). Lengths that go in are dp.
// Thread: main. Errors: none.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "hal/base/result.h"
#include "ui/device/settings.h"
#include "ui/draw/theme.h"
#include "ui/language/language.h"
#include "ui/screens/parts/page.h"
#include "ui/view/service.h"
#include "ui/view/service_view.h"
#include "ui/view/staff_views.h"

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

// Plot: a series of values as bars or as a line, with an axis of round numbers and the limit across it. Who
// listens is told the highest, the newest and the limit. It runs from left to right in every language, as
// tables of measurements do. Thread: main. Errors: none.
enum class PlotLook : std::uint8_t { Bars, Line };

struct Plot {
  std::string_view id, title;
  std::string_view figure;  // beside the title: a sum, a median, what it is now
  Colour figure_ink{};      // not seen: as figures are
  const char* figure_sign = nullptr;
  std::span<const float> values;            // NaN: not known
  std::span<const std::string_view> names;  // where each value belongs on the axis: a day, a time
  PlotLook look = PlotLook::Bars;
  const char* unit = "";
  float limit = std::numeric_limits<float>::quiet_NaN();  // NaN: there is none
  std::array<std::string_view, 3>
      under{};  // at the axis' start, middle and end; empty: those of the values there
};

// From a round number to a round number, by a step of 1, 2 or 5 times a power of ten.
struct PlotScale {
  double from = 0, step = 1;
  int steps = 1;
  double to() const { return from + step * steps; }
  double share(double value) const { return (value - from) / (to() - from); }
  int decimals() const;  // that its numbers need
};
// Holds 0 and all that is known; of nothing: 0 to 1.
PlotScale plot_scale(std::span<const float> values, float limit);

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
  Node line_box(float thick_dp, Colour colour) const;           // as wide as its room
  void rule() { tree.leaf(line_box(1, palette.card_border)); }  // a thin line between rows
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

// The sentence of every error code and of every event of the log, in the reader's language. Thread: any.
// Errors: none.
const char* words_of(const Words& tr, Errc code);

// `pattern` has a place {} for each value of the event, or for `role` where that is there.
struct LogWords {
  const char* pattern = "";
  const char* role = nullptr;
};
LogWords words_of(const Words& tr, LogEvent event);

// What a setting and its values are called: alike on the settings page and in the log.
const char* name_of(const Words& tr, Setting setting);
// `value` is one of info_of(setting).values.
std::string_view said_value(StaffFrame& page, Setting setting, std::int32_t value);

// A change as the log keeps it; empty where that is no setting, or no value of it (an older version's).
std::string_view said_change(StaffFrame& page, std::string_view key, std::string_view value);

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
