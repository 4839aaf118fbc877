// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ListPlace: where one is in a list of many pages, and the ways to another place, as the shared part of all
// lists draws them (ui/screens/service/list_part.h). Borrowed for one frame. Thread: main.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace relievo::ui {

// Pages, counted from 0, both ends included; and what stands at the top of the first: a date, a number.
struct ListStretch {
  std::int64_t first = 0, last = 0;
  std::string_view label;
};
inline constexpr std::size_t kListStretches = 10;

struct ListPlace {
  std::int64_t page = 0, pages = 1;
  std::array<ListStretch, kListStretches> stretches{};  // of what was divided last
  std::size_t stretch_count = 0;                        // 0: they are being looked up
  std::size_t filter = 0;                               // of the page's own; 0: all rows
};

}  // namespace relievo::ui
