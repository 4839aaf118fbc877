// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/file/yaml_fields.h"

#include <charconv>
#include <cmath>
#include <functional>
#include <set>

namespace relievo::pipeline {
namespace {

constexpr int kMaxMatrixCells = 4096;

struct Line {
  std::string_view text;  // without its end and without blanks at the end
  int number = 0;
  bool ended = false;  // by a line feed: the last number of a file that was cut is not
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  int number = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(
        {line.substr(0, line.find_last_not_of(" \t") + 1), ++number, end != std::string_view::npos});
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

Error wrong(const Line& line, Literal what) {
  return Error{Errc::InvalidInput, what}.at("line " + std::to_string(line.number));
}

// The whole token or nothing.
template <typename Number>
bool parse_whole(std::string_view token, Number& number) {
  if (token.starts_with('+')) token.remove_prefix(1);
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), number);
  return error == std::errc{} && end == token.data() + token.size();
}

bool is_name(std::string_view key) {
  return !key.empty() && key.find_first_not_of(
                             "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                             "0123456789_-.") == std::string_view::npos;
}

// Cuts "key: value" in two; false if the line has no such form.
bool split(std::string_view line, std::string_view& key, std::string_view& value) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return false;
  key = trimmed(line.substr(0, colon));
  value = trimmed(line.substr(colon + 1));
  return is_name(key);
}

class Reader {
 public:
  explicit Reader(std::string_view text) : lines_(lines_of(text)) {}

  Result<YamlFields> read() {
    while (at_ < lines_.size()) {
      const Line& line = lines_[at_];
      if (skip_prologue(line)) continue;
      if (line.text.starts_with("...")) break;
      RELIEVO_TRY(read_field(line));
    }
    return std::move(fields_);
  }

 private:
  bool skip_prologue(const Line& line) {
    const bool nothing = line.text.empty() || line.text.starts_with('#') || line.text.starts_with('%') ||
                         line.text.starts_with("---");
    if (nothing) ++at_;
    return nothing;
  }

  Result<void> read_field(const Line& line) {
    std::string_view key;
    std::string_view value;
    if (line.text.front() == ' ' || !split(line.text, key, value))
      return wrong(line, "not of the form `name: value`; the file is damaged or no calibration");
    if (!seen_.emplace(key).second)
      return wrong(line, "this field is there twice; calibrate again or mend the file");
    ++at_;
    if (value.starts_with("!!opencv-matrix")) return read_matrix(key, line);
    if (!value.empty() && value.front() != '"' && value.front() != '[') {
      if (!line.ended) return wrong(line, "the file ends inside this line; it was cut short, copy it again");
      double number = 0;
      if (parse_whole(value, number) && std::isfinite(number)) fields_.numbers.emplace(key, number);
    }
    return skip_indented(value);
  }

  // A value that is not ours: its indented lines, with every bracket closed.
  Result<void> skip_indented(std::string_view value) {
    int open = 0;
    const auto count = [&open](std::string_view text) {
      for (const char c : text) open += (c == '[' || c == '{') - (c == ']' || c == '}');
    };
    count(value);
    while (at_ < lines_.size() && (lines_[at_].text.starts_with(' ') || lines_[at_].text.starts_with('-')) &&
           !lines_[at_].text.starts_with("---"))
      count(lines_[at_++].text);
    if (open != 0)
      return wrong(lines_[at_ - 1], "a bracket is not closed; the file was cut short, copy it again");
    return {};
  }

  Result<void> read_matrix(std::string_view key, const Line& head) {
    YamlMatrix matrix;
    bool has_type = false;
    while (at_ < lines_.size() && lines_[at_].text.starts_with(' ')) {
      const Line& line = lines_[at_];
      std::string_view name;
      std::string_view value;
      if (!split(line.text, name, value)) return wrong(line, "not of the form `name: value` inside a matrix");
      ++at_;
      if (name == "rows" || name == "cols") {
        int& side = name == "rows" ? matrix.rows : matrix.cols;
        if (!line.ended || side != 0 || !parse_whole(value, side) || side < 1 || side > kMaxMatrixCells)
          return wrong(line, "rows and cols of a matrix must be small whole numbers");
      } else if (name == "dt") {
        has_type = value == "d" || value == "f" || value == "i";
        if (!line.ended || !has_type) return wrong(line, "the type of a matrix must be d, f or i");
      } else if (name == "data") {
        if (!has_type || matrix.rows == 0 || matrix.cols == 0)
          return wrong(line, "rows, cols and dt must come before the data of a matrix");
        RELIEVO_TRY(read_data(value, line, matrix));
        fields_.matrices.emplace(key, std::move(matrix));
        return {};
      } else {
        return wrong(line, "a matrix has rows, cols, dt and data only");
      }
    }
    return wrong(head, "this matrix has no data; the file was cut short or damaged");
  }

  Result<void> read_data(std::string_view text, const Line& first, YamlMatrix& matrix) {
    const Line* line = &first;
    if (!text.starts_with('[')) return wrong(*line, "the data of a matrix must stand in [ ]");
    text.remove_prefix(1);
    std::string list;
    while (text.find(']') == std::string_view::npos) {
      list.append(text).push_back(' ');
      if (at_ >= lines_.size() || !lines_[at_].text.starts_with(' '))
        return wrong(*line, "this list is not closed; the file was cut short, copy it again");
      line = &lines_[at_++];
      text = line->text;
    }
    const auto close = text.find(']');
    if (!trimmed(text.substr(close + 1)).empty()) return wrong(*line, "something follows the closed list");
    list.append(text.substr(0, close));
    return read_numbers(list, *line, matrix);
  }

  static Result<void> read_numbers(std::string_view list, const Line& line, YamlMatrix& matrix) {
    const auto cells = static_cast<std::size_t>(matrix.rows) * static_cast<std::size_t>(matrix.cols);
    while (true) {
      const auto comma = list.find(',');
      double number = 0;
      if (!parse_whole(trimmed(list.substr(0, comma)), number) || !std::isfinite(number))
        return wrong(line, "a value in the list above is no finite number");
      matrix.values.push_back(number);
      if (matrix.values.size() > cells) break;
      if (comma == std::string_view::npos) break;
      list.remove_prefix(comma + 1);
    }
    if (matrix.values.size() != cells) return wrong(line, "the list has not rows times cols numbers");
    return {};
  }

  std::vector<Line> lines_;
  std::size_t at_ = 0;
  std::set<std::string, std::less<>> seen_;
  YamlFields fields_;
};

}  // namespace

Result<YamlFields> parse_yaml_fields(std::string_view text) {
  if (text.find('\0') != std::string_view::npos)
    return Error{Errc::InvalidInput, "holds bytes that are no text; give a calibration such as rig.yml"};
  return Reader(text).read();
}

}  // namespace relievo::pipeline
