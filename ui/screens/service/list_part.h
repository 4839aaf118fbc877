// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every list of more than a page has: first, back, where one is, on, last, and its filters. "Where one
// is" opens the ways to another place: ten stretches of the list, each with what stands at its top (a date, a
// number); one that is touched is divided again, down to a page. Thread: main. Errors: none.
#pragma once

#include <span>

#include "ui/screens/service/staff_frame.h"
#include "ui/view/list_place.h"

namespace relievo::ui {

using ListFilters = std::span<const std::string_view>;  // names; the first one lets all rows pass

// In place of a page whose list is jumped in or filtered; false: it is not, nothing was drawn.
bool list_choice(StaffFrame& page, const ListPlace& place, ListFilters filters = {});
// Under a list; nothing where it has one page and no filters.
void list_pager(StaffFrame& page, const ListPlace& place, ListFilters filters = {});

}  // namespace relievo::ui
