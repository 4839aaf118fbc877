// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected parts of a grid, by its four neighbours: their cells are labelled 1, 2 and so on, in the
// order of each part's first cell. Thread: any. Errors: none.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace relievo::pipeline {

// `label` is 0 before and where belongs(cell) is not; together(cell, neighbour) may part two that belong.
// found(cells): of one part after the other, breadth first.
template <typename Label, typename Belongs, typename Together, typename Found>
void label_parts(std::span<Label> label, std::size_t width, std::pmr::memory_resource* memory,
                 const Belongs& belongs, const Together& together, const Found& found) {
  std::pmr::vector<std::uint32_t> cells(memory);
  cells.reserve(label.size());
  Label part = 0;
  for (std::size_t start = 0; start < label.size(); ++start) {
    if (label[start] != 0 || !belongs(start)) continue;
    ++part;
    std::size_t from = start;
    const auto join = [&](std::size_t to) {
      if (label[to] != 0 || !belongs(to) || !(from == to || together(from, to))) return;
      label[to] = part;
      cells.push_back(std::uint32_t(to));
    };
    cells.clear();
    join(start);
    for (std::size_t next = 0; next < cells.size(); ++next) {
      from = cells[next];
      if (from % width > 0) join(from - 1);
      if (from % width + 1 < width) join(from + 1);
      if (from >= width) join(from - width);
      if (from + width < label.size()) join(from + width);
    }
    found(std::span<const std::uint32_t>(cells));
  }
}

}  // namespace relievo::pipeline
