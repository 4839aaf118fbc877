// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/file/file_matcher.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20;
constexpr int kCorrelationRadius = 4;

Result<std::pmr::vector<char>> read_text(const std::string& path, std::pmr::memory_resource* memory) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure))
    return Error{Errc::NotFound, "no such file: --set file-matches.path=FILE names it"}.at(path);
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

struct Reader {
  const RectifiedPair& pair;
  const FileMatcherOptions& options;

  bool inside(double x, double y) const {
    return x >= 0 && y >= 0 && x <= pair.width_px - 1 && y <= pair.height_px - 1;
  }

  Result<Match> read(const Numbers& n) const {
    if (n.count < 3)
      return Error{Errc::InvalidInput,
                   "a match is x y disparity [sigma], numbers with blanks or commas between"};
    const auto [x, y, d, sigma] = n.value;
    if (!inside(x, y)) return Error{Errc::InvalidInput, "the place lies outside the left picture"};
    if (!inside(x - d, y))
      return Error{Errc::InvalidInput, "with this disparity the partner lies outside the right picture"};
    if (n.count == 4 && !(sigma > 0 && sigma <= 1000))
      return Error{Errc::InvalidInput, "sigma must be positive, at most 1000 pixels"};
    const Vec2f at{static_cast<float>(x), static_cast<float>(y)};
    const auto disparity = static_cast<float>(d);
    return Match{at, disparity, window_cost(pair, at, disparity, kCorrelationRadius),
                 n.count == 4 ? static_cast<float>(sigma) : options.sigma_px, 0};
  }
};

std::string line_name(const std::string& path, int line) { return path + " line " + std::to_string(line); }

}  // namespace

Result<MatchSet> FileMatcher::match(const RectifiedPair& pair, const Keypoints&,
                                    StageContext& context) const {
  if (pair.width_px <= 0 || pair.height_px <= 0 || pair.left.grey.empty() || pair.right.grey.empty())
    return Error{Errc::InvalidInput, "the rectified pair has no pixels"};
  if (options_.path.empty())
    return Error{Errc::NotFound, "no file of matches is named: --set file-matches.path=FILE"}.at(
        "file-matches.path");
  RELIEVO_TRY_ASSIGN(const std::pmr::vector<char> text, read_text(options_.path, &context.scratch));
  std::string_view rest(text.data(), text.size());
  MatchSet set(&context.output);
  set.matches.reserve(static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1);
  const Reader reader{pair, options_};
  for (int line = 1; !rest.empty(); ++line) {
    if (line % 64 == 0 && context.stop()) break;
    const std::size_t end = rest.find('\n');
    std::string_view one = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    const auto numbers = read_numbers(one.substr(0, one.find('#')));
    if (!numbers)
      return Error{Errc::InvalidInput,
                   "a match is x y disparity [sigma], numbers with blanks or commas between"}
          .at(line_name(options_.path, line));
    if (numbers->count == 0) continue;
    const auto match = reader.read(*numbers);
    if (!match) return match.error().at(line_name(options_.path, line));
    set.matches.push_back(*match);
  }
  if (context.stop()) return Error{Errc::Cancelled, "stopped while reading matches"};
  if (set.matches.empty()) return Error{Errc::TooFewMatches, "the file holds no match"}.at(options_.path);
  return set;
}

}  // namespace relievo::pipeline
