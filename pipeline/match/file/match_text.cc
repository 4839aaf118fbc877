// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/file/match_text.h"

#include "pipeline/match/file/number_lines.h"

namespace relievo::pipeline {
namespace {

Result<Match> match_of(const NumberLine& n, const RectifiedPair& windows, float sigma_px) {
  const auto inside = [&windows](double x, double y) {
    return x >= 0 && y >= 0 && x <= windows.width_px - 1 && y <= windows.height_px - 1;
  };
  if (n.count < 3 || !n.rest.empty())
    return Error{Errc::InvalidInput,
                 "a match is x y disparity [sigma], numbers with blanks or commas between"};
  const auto [x, y, d, sigma] = n.value;
  if (!inside(x, y)) return Error{Errc::InvalidInput, "the place lies outside the left picture"};
  if (!inside(x - d, y))
    return Error{Errc::InvalidInput, "with this disparity the partner lies outside the right picture"};
  if (n.count == 4 && !(sigma > 0 && sigma <= 1000))
    return Error{Errc::InvalidInput, "sigma must be positive, at most 1000 pixels"};
  return Match{{static_cast<float>(x), static_cast<float>(y)},
               static_cast<float>(d),
               0,
               n.count == 4 ? static_cast<float>(sigma) : sigma_px,
               0};
}

}  // namespace

Result<std::pmr::vector<Match>> matches_in(std::string_view text, const std::string& file,
                                           const RectifiedPair& windows, float sigma_px,
                                           std::pmr::memory_resource* memory) {
  std::pmr::vector<Match> matches(memory);
  matches.reserve(lines_of(text));
  NumberLines lines(text, 4);
  for (NumberLine line; lines.next(line);) {
    const auto match = match_of(line, windows, sigma_px);
    if (!match) return match.error().at(line_name(file, line.number));
    matches.push_back(*match);
  }
  return matches;
}

}  // namespace relievo::pipeline
