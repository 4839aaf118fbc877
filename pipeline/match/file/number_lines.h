// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of numbers in a text that somebody else wrote. Numbers are apart by blanks, tabs, a comma or a
// semicolon; the decimal sign is a point; '#' begins a comment. Empty lines and a first line of words (titles
// of columns) are passed over. Nothing is copied, so a text may have any length. Errors: none; who reads a
// line judges it. Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace relievo::pipeline {

struct NumberLine {
  std::array<double, 4> value{};  // finite
  std::size_t count = 0;          // of them
  std::string_view rest;          // what stands behind them, without blanks around it
  std::uint32_t number = 0;       // of the line, from 1
};

class NumberLines {
 public:
  // `most`: numbers that are read of a line, 4 at most. The text is borrowed.
  NumberLines(std::string_view text, std::size_t most) : text_(text), most_(most) {}
  // False at the end of the text.
  bool next(NumberLine& line);

 private:
  std::string_view text_;
  std::size_t most_;
  std::uint32_t number_ = 0;
  bool first_ = true;
};

// How many lines a text has at most: for making room.
std::size_t lines_of(std::string_view text);
// "points.csv, line 12"
std::string line_name(const std::string& file, std::uint32_t line);

}  // namespace relievo::pipeline
