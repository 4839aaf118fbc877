// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/staff_frame.h"

#include <algorithm>

#include "hal/base/utf8.h"

namespace relievo::ui {
namespace {

// A page's own modes are small numbers.
enum ListMode : int { kJumping = 100, kFiltering };
constexpr const char *kFirstSign = "\uf600", *kLastSign = "\uf601", *kFilterSign = "\uf232";

Action list_action(const ListRequest& request, int mode = 0) {
  Action action(request, true);
  action.value = mode;
  return action;
}

std::string_view page_number(StaffFrame& page, std::int64_t number) { return page.number(number + 1); }

void stretches(StaffFrame& page, const ListPlace& place) {
  page.begin_list("stretches");
  if (place.stretch_count == 0) page.line(page.tr("One moment, please"));
  for (std::size_t i = 0; i < place.stretch_count; ++i) {
    const ListStretch& one = place.stretches[i];
    const bool single = one.first == one.last;
    const std::string_view pages = single ? page_number(page, one.first)
                                          : page.left_to_right({page_number(page, one.first), "\u00a0–\u00a0",
                                                                page_number(page, one.last)});
    const std::string_view dated = page.date(one.label);
    const bool here = one.first <= place.page && place.page <= one.last;
    page.row(
        page.id("stretch", i), dated == one.label ? page.with_numbers(one.label) : dated, pages,
        here ? Mood::Good : Mood::Plain,
        single ? list_action(GoToPage{one.first}) : list_action(DivideList{one.first, one.last}, kJumping));
  }
  page.tree.close();
}

bool is_letter(std::string_view name) { return !name.empty() && first_letter_of(name).bytes == name.size(); }

// Letters abreast, from `first` on; the place after the last one.
std::size_t letter_row(StaffFrame& page, const ListPlace& place, ListFilters filters, std::size_t first) {
  const std::size_t across = page.portrait ? 5 : 10;
  page.tree.open(page.box(Flow::Row, space::kXs, 0, 4));
  std::size_t i = first;
  for (; i < first + across && i < filters.size() && is_letter(filters[i]); ++i)
    page.small_button(page.id("filter", i), filters[i], nullptr,
                      i == place.filter ? ButtonLook::Main : ButtonLook::Quiet, list_action(FilterList{i}),
                      1);
  for (std::size_t empty = i; empty < first + across; ++empty) page.space(1);
  page.tree.close();
  return i;
}

void filter_rows(StaffFrame& page, const ListPlace& place, ListFilters filters) {
  page.begin_list("filters");
  for (std::size_t i = 0; i < filters.size();) {
    if (is_letter(filters[i])) {
      i = letter_row(page, place, filters, i);
      continue;
    }
    const bool chosen = i == place.filter;
    page.row(page.id("filter", i), filters[i], chosen ? page.tr("chosen") : "",
             chosen ? Mood::Good : Mood::Plain, list_action(FilterList{i}));
    ++i;
  }
  if (filters.size() == 1) page.line(page.tr("One moment, please"));
  page.tree.close();
}

// To `to`; where the list ends there is nothing to be touched, and the others keep their places.
void step(StaffFrame& page, std::string_view id, const char* spoken, const char* letter, std::int64_t to,
          bool ends) {
  Node node = centred(page.sized(page.box(Flow::Row), size::kStaffTarget, size::kStaffTarget));
  if (!ends) {
    tell(node, Role::Button, id, spoken, list_action(GoToPage{to}));
    frame(node, page.palette.quiet, page.palette.quiet_border, page.px(2), page.px(18));
  }
  const auto in_node = page.tree.inside(node);
  if (!ends) page.sign(letter, 28 / page.text_share, page.palette.link);
}

}  // namespace

bool list_choice(StaffFrame& page, const ListPlace& place, ListFilters filters) {
  if (page.service.mode == kJumping) stretches(page, place);
  else if (page.service.mode == kFiltering) filter_rows(page, place, filters);
  else return false;
  return true;
}

void list_pager(StaffFrame& page, const ListPlace& place, ListFilters filters) {
  const auto& tr = page.tr;
  if (place.pages < 2 && filters.empty()) return;
  const std::int64_t last = place.pages - 1;
  const bool at_first = place.page == 0, at_last = place.page == last, turned = page.mirrored();
  const auto in_box = page.tree.inside(page.box(Flow::Row, space::kXs));
  if (place.pages > 1) {
    step(page, "first page", tr("First page"), turned ? kLastSign : kFirstSign, 0, at_first);
    step(page, "page back", tr("One page back"), page.backward(), place.page - 1, at_first);
    page.small_button(
        "page number",
        page.left_to_right({page_number(page, place.page), "\u00a0/\u00a0", page_number(page, last)}),
        nullptr, ButtonLook::Quiet, list_action(DivideList{0, last}, kJumping), 1);
    step(page, "page on", tr("One page on"), page.onward(), place.page + 1, at_last);
    step(page, "last page", tr("Last page"), turned ? kFirstSign : kLastSign, last, at_last);
  }
  // The name of a rule is long: where the row has no room for it, it stands below.
  const bool below = place.pages > 1 && page.little_room();
  if (below && !filters.empty()) {
    page.tree.close();
    page.tree.open(page.box(Flow::Row, space::kXs));
  }
  if (!filters.empty())
    page.small_button("filter", filters[std::min(place.filter, filters.size() - 1)], kFilterSign,
                      place.filter == 0 ? ButtonLook::Quiet : ButtonLook::Main,
                      list_action(FindFilters{}, kFiltering), below || place.pages < 2 ? 1 : 0);
}

}  // namespace relievo::ui
