// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which algorithms there are, which are chosen, and the option that is being edited; and a page of a
// table of numbers. Texts are borrowed for a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "ui/technician/technician_result.h"
#include "ui/view/list_place.h"

namespace relievo::ui {

struct TechnicianName {
  std::string_view name;
  bool chosen = false;
};
struct TechnicianKind {
  std::string_view key, value, sentence;
  bool several = false;
};
struct TechnicianOption {
  std::string_view key, value, sentence;
  double least = 0, most = 0;
  bool text = false, changed = false;
};
struct TechnicianChoice {
  std::span<const TechnicianKind> kinds;
  std::size_t kind = 0;
  std::span<const TechnicianName> names;      // of the kind
  std::span<const TechnicianOption> options;  // of the kind's chosen algorithms
  const TechnicianOption* edited = nullptr;   // one of them
  std::string_view typed, refused;            // what was typed, and why it was not taken
  bool changed = false;                       // since the last run
};

inline constexpr std::size_t kTableColumns = 8;
struct TechnicianRows {
  TechnicianTable table = TechnicianTable::Matches;
  std::span<const std::string_view> heads;  // symbols and units
  std::span<const std::string_view> cells;  // row by row
  ListPlace place;  // of matches also filtered; 1: accepted, from 2 on rejected by that rule of the result
};

}  // namespace relievo::ui
