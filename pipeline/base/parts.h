// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected parts of a grid, by its four neighbours: their cells are labelled 1, 2 and so on, in the
// order of each part's first cell. Thread: any. Errors: none.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace relievo::pipeline {

// Calls visit(neighbour) for the neighbours that a cell has.
template <typename Visit>
void for_each_beside(std::size_t cell, std::size_t width, std::size_t size, const Visit& visit) {
  if (cell % width > 0) visit(cell - 1);
  if (cell % width + 1 < width) visit(cell + 1);
  if (cell >= width) visit(cell - width);
  if (cell + width < size) visit(cell + width);
}

// Calls visit(cell) for a cell of `columns` * `rows` and its neighbours, corners included, row by row.
template <typename Visit>
void for_each_around(int column, int row, int columns, int rows, const Visit& visit) {
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows - 1); ++r)
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns - 1); ++c)
      visit(std::uint32_t(r * columns + c));
}

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
      for_each_beside(from, width, label.size(), join);
    }
    found(std::span<const std::uint32_t>(cells));
  }
}

}  // namespace relievo::pipeline
