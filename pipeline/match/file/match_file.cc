// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/file/match_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

namespace relievo::pipeline {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20;

Result<std::pmr::vector<char>> read_text(const std::string& path, std::pmr::memory_resource* memory) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure))
    return Error{Errc::NotFound, "cannot be opened; check the name"}.at(path);
  if (!std::filesystem::is_regular_file(path, failure))
    return Error{Errc::InvalidInput, "not a file of matches"}.at(path);
  const auto size = std::filesystem::file_size(path, failure);
  if (failure) return Error{Errc::IoFailed, "its size cannot be read"}.at(path);
  if (size > kMostBytes) return Error{Errc::InvalidInput, "more than 4 MiB is no file of matches"}.at(path);
  std::pmr::vector<char> text(static_cast<std::size_t>(size), '\0', memory);
  std::ifstream in(path, std::ios::binary);
  if (!in || (size > 0 && !in.read(text.data(), static_cast<std::streamsize>(size))))
    return Error{Errc::IoFailed, "it cannot be read"}.at(path);
  return text;
}

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

void skip_blanks(std::string_view& line) {
  while (!line.empty() && blank(line.front())) line.remove_prefix(1);
}

struct Numbers {
  std::array<double, 4> value{};
  std::size_t count = 0;
};

// Up to four finite numbers; none where there is anything else.
std::optional<Numbers> read_numbers(std::string_view line) {
  Numbers numbers;
  skip_blanks(line);
  while (!line.empty()) {
    if (numbers.count == numbers.value.size()) return std::nullopt;
    double& value = numbers.value[numbers.count];
    const auto [end, failure] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (failure != std::errc{} || !std::isfinite(value)) return std::nullopt;
    ++numbers.count;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    const std::size_t before = line.size();
    skip_blanks(line);
    if (!line.empty() && line.front() == ',') {
      line.remove_prefix(1);
      skip_blanks(line);
      if (line.empty()) return std::nullopt;
    } else if (!line.empty() && line.size() == before) {
      return std::nullopt;  // "12x"
    }
  }
  return numbers;
}

Result<Match> match_of(const Numbers& n, const RectifiedPair& windows, float sigma_px) {
  const auto inside = [&windows](double x, double y) {
    return x >= 0 && y >= 0 && x <= windows.width_px - 1 && y <= windows.height_px - 1;
  };
  if (n.count < 3)
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

std::string line_name(const std::string& path, int line) { return path + " line " + std::to_string(line); }

}  // namespace

Result<std::pmr::vector<Match>> read_match_file(const std::string& path, const RectifiedPair& windows,
                                                float sigma_px, std::pmr::memory_resource* memory) {
  RELIEVO_TRY_ASSIGN(const std::pmr::vector<char> text, read_text(path, memory));
  std::string_view rest(text.data(), text.size());
  std::pmr::vector<Match> matches(memory);
  matches.reserve(static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1);
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    const std::string_view one = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    const auto numbers = read_numbers(one.substr(0, one.find('#')));
    if (!numbers)
      return Error{Errc::InvalidInput,
                   "a match is x y disparity [sigma], numbers with blanks or commas between"}
          .at(line_name(path, line));
    if (numbers->count == 0) continue;
    const auto match = match_of(*numbers, windows, sigma_px);
    if (!match) return match.error().at(line_name(path, line));
    matches.push_back(*match);
  }
  return matches;
}

}  // namespace relievo::pipeline
