// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// NumberTable: lines of numbers from a text file somebody else made, read with suspicion.
// A line holds at least `columns` numbers, apart by a comma, a semicolon or blanks; the rest of it is not
// looked at. Empty lines, lines that begin with # and a first line of words are passed over.
// Errors: NotFound, IoFailed (cannot be opened or read); InvalidInput with file and line: not a number, not
// finite, too few; no file (a folder, a pipe), too large, too many lines, no line at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/arena.h"
#include "hal/base/result.h"

namespace relievo::pipeline {

class NumberTable {
 public:
  NumberTable(std::string path, std::size_t columns, std::pmr::memory_resource* memory)
      : path_(std::move(path)), columns_(columns), values_(memory), lines_(memory) {}

  std::size_t rows() const { return lines_.size(); }
  double at(std::size_t row, std::size_t column) const { return values_[row * columns_ + column]; }
  std::string place(std::size_t row) const;  // "points.csv, line 12"

 private:
  friend Result<NumberTable> parse_number_table(std::string_view text, std::string path, std::size_t columns,
                                                std::size_t most_rows, std::pmr::memory_resource* memory);
  std::string path_;
  std::size_t columns_;
  std::pmr::vector<double> values_;
  std::pmr::vector<std::uint32_t> lines_;  // from 1
};

Result<NumberTable> read_number_table(const std::string& path, std::size_t columns, std::size_t most_rows,
                                      Arena& memory);
// `path` is only for the errors.
Result<NumberTable> parse_number_table(std::string_view text, std::string path, std::size_t columns,
                                       std::size_t most_rows, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
