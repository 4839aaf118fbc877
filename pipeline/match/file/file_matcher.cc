// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/file/file_matcher.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr int kCorrelationRadius = 4;
constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kBetween = ",; \t\r";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

bool is_title(std::string_view line) {
  return std::ranges::all_of(line, [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           kBetween.find(char(c)) != std::string_view::npos;
  });
}

// The next number, taken off the front with what parts it from the one before; false: there is none.
bool take_number(std::string_view& line, bool first, double& value) {
  std::string_view rest = trimmed(line);
  if (!first && !rest.empty() && (rest.front() == ',' || rest.front() == ';')) rest = trimmed(rest.substr(1));
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  const auto [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (failure != std::errc{} || !std::isfinite(value)) return false;
  rest.remove_prefix(std::size_t(end - rest.data()));
  if (!rest.empty() && kBetween.find(rest.front()) == std::string_view::npos) return false;  // "12x"
  line = rest;
  return true;
}

Result<Match> match_of(const NumberLine& n, const RectifiedPair& windows, float sigma_px) {
  const auto inside = [&windows](double x, double y) {
    return x >= 0 && y >= 0 && x <= windows.width_px - 1 && y <= windows.height_px - 1;
  };
  if (n.count < 3 || !n.rest.empty())
    return invalid("a match is x y disparity [sigma], numbers with blanks or commas between");
  const auto [x, y, d, sigma] = n.value;
  if (!inside(x, y)) return invalid("the place lies outside the left picture");
  if (!inside(x - d, y)) return invalid("with this disparity the partner lies outside the right picture");
  if (n.count == 4 && !(sigma > 0 && sigma <= 1000))
    return invalid("sigma must be positive, at most 1000 pixels");
  return Match{{float(x), float(y)}, float(d), 0, n.count == 4 ? float(sigma) : sigma_px, 0};
}

}  // namespace

bool NumberLines::next(NumberLine& line) {
  while (!text_.empty()) {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view one = text_.substr(0, end);
    text_.remove_prefix(std::min(text_.size(), end + 1));
    ++number_;
    one = trimmed(one.substr(0, one.find('#')));
    if (one.empty()) continue;
    if (std::exchange(first_, false) && is_title(one)) continue;
    line = {};
    line.number = number_;
    while (line.count < most_ && take_number(one, line.count == 0, line.value[line.count])) ++line.count;
    line.rest = trimmed(one);
    return true;
  }
  return false;
}

std::size_t lines_of(std::string_view text) { return std::size_t(std::ranges::count(text, '\n')) + 1; }

std::string line_name(const std::string& file, std::uint32_t line) {
  return file + ", line " + std::to_string(line);
}

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

Result<MatchSet> FileMatcher::match(const RectifiedPair& pair, const Keypoints&,
                                    StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  if (file.path.empty())
    return Error{Errc::NotFound, "no file of matches is named: --set file-matches.path=FILE"}.at(
        "file-matches.path");
  if (file.text == nullptr)
    return Error{Errc::NotFound, "this file of matches could not be read; check its name"}.at(file.path);
  MatchSet set(&context.output);
  RELIEVO_TRY_ASSIGN(set.matches, matches_in(*file.text, file.path, pair, sigma_px, &context.output));
  for (Match& match : set.matches) {
    if (context.stop()) return stopped();
    match.cost = window_cost(pair, match.left_px, match.disparity_px, kCorrelationRadius);
  }
  if (set.matches.empty()) return Error{Errc::TooFewMatches, "the file holds no match"}.at(file.path);
  return set;
}

}  // namespace relievo::pipeline
