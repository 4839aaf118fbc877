// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Matches made by hand or elsewhere, as text. One match a line:
//
//   # left x, left y, disparity, and one standard deviation of the disparity where it is known
//   512.5 300 41.25
//   600, 310.5, 40, 0.2
//
// full-size rectified pixels. A match has one row, so none can leave its epipolar line. Errors: InvalidInput
// with file and line (not three or four numbers, a place outside, a sigma not positive). Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Lines of numbers in a text that somebody else wrote. Numbers are apart by blanks, tabs, a comma or a
// semicolon; the decimal sign is a point; '#' begins a comment. A byte order mark, empty lines and a first
// line of words (titles of columns) are passed over. Nothing is copied, so a text may have any length.
// Errors: none; who reads a line judges it. Thread: any.
struct NumberLine {
  std::array<double, 4> value{};  // finite
  std::size_t count = 0;          // of them
  std::string_view rest;          // what stands behind them, without blanks around it
  std::uint32_t number = 0;       // of the line, from 1
};

class NumberLines {
 public:
  // `most`: numbers that are read of a line, 4 at most. The text is borrowed.
  NumberLines(std::string_view text, std::size_t most)
      : text_(text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0)), most_(most) {}
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

inline constexpr float kHandSigmaPx = 0.5F;  // what a careful hand reaches

// In the order of the text, which may hold none; cost is 0. `file` is for the errors. Of `windows` no pixel
// is looked at. `sigma_px` is that of matches whose line has none.
Result<std::pmr::vector<Match>> matches_in(std::string_view text, const std::string& file,
                                           const RectifiedPair& windows, float sigma_px,
                                           std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
