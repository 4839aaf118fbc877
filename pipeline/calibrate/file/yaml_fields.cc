// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include <yaml.h>

#include "pipeline/calibrate/file/calibration_fields.h"

namespace relievo::pipeline {
namespace {

constexpr int kDeepest = 32;
constexpr int kMostCells = 4096;

Error at_line(std::size_t line, Literal what) { return invalid(what).at("line " + std::to_string(line)); }

// One event of libyaml; its memory goes with it.
class Event {
 public:
  Event() = default;
  ~Event() { yaml_event_delete(&event_); }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;

  yaml_event_t* raw() { return &event_; }
  yaml_event_type_t type() const { return event_.type; }
  std::size_t line() const { return event_.start_mark.line + 1; }
  // Of a scalar. Quoted text is text even where it looks like a number.
  std::string_view text() const {
    return {reinterpret_cast<const char*>(event_.data.scalar.value), event_.data.scalar.length};
  }
  bool plain() const { return event_.data.scalar.style == YAML_PLAIN_SCALAR_STYLE; }
  // Of a map.
  std::string_view tag() const {
    const auto* tag = event_.data.mapping_start.tag;
    return tag != nullptr ? reinterpret_cast<const char*>(tag) : std::string_view();
  }
  bool named() const {
    const yaml_event_type_t is = event_.type;
    return is == YAML_ALIAS_EVENT || (is == YAML_SCALAR_EVENT && event_.data.scalar.anchor != nullptr) ||
           (is == YAML_SEQUENCE_START_EVENT && event_.data.sequence_start.anchor != nullptr) ||
           (is == YAML_MAPPING_START_EVENT && event_.data.mapping_start.anchor != nullptr);
  }

 private:
  yaml_event_t event_{};
};

bool begins(yaml_event_type_t type) {
  return type == YAML_SEQUENCE_START_EVENT || type == YAML_MAPPING_START_EVENT;
}
bool ends(yaml_event_type_t type) {
  return type == YAML_SEQUENCE_END_EVENT || type == YAML_MAPPING_END_EVENT;
}

// The whole word or nothing.
template <typename Number>
bool parse_whole(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

bool parse_finite(const Event& event, double& number) {
  return event.plain() && parse_whole(event.text(), number) && std::isfinite(number);
}

class Reader {
 public:
  // `first_line` lines of the file stand before the text.
  Reader(std::string_view text, std::size_t first_line)
      : skipped_(first_line), ready_(yaml_parser_initialize(&parser_) != 0) {
    if (!ready_) return;
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  ~Reader() {
    if (ready_) yaml_parser_delete(&parser_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Result<YamlFields> read() {
    if (!ready_) return Error{Errc::OutOfMemory, "there is not enough memory to read this file"};
    RELIEVO_TRY(expect(YAML_STREAM_START_EVENT));
    RELIEVO_TRY(expect(YAML_DOCUMENT_START_EVENT));
    RELIEVO_TRY(expect(YAML_MAPPING_START_EVENT));
    for (;;) {
      Event key;
      RELIEVO_TRY(next(key));
      if (key.type() == YAML_MAPPING_END_EVENT) break;
      RELIEVO_TRY(read_field(key));
    }
    RELIEVO_TRY(expect(YAML_DOCUMENT_END_EVENT));
    RELIEVO_TRY(expect(YAML_STREAM_END_EVENT));
    return std::move(fields_);
  }

 private:
  Error wrong(const Event& event, Literal what) const { return at_line(skipped_ + event.line(), what); }

  Result<void> next(Event& event) {
    if (yaml_parser_parse(&parser_, event.raw()) == 0) {
      const std::size_t line = skipped_ + parser_.problem_mark.line + 1;
      if (parser_.error == YAML_MEMORY_ERROR)
        return Error{Errc::OutOfMemory, "there is not enough memory to read this file"};
      if (parser_.error == YAML_READER_ERROR)
        return invalid("holds bytes that are no text; give a calibration such as rig.yml")
            .at("byte " + std::to_string(parser_.problem_offset));
      return at_line(line, "is no YAML here; the file was cut short or damaged, copy it again");
    }
    if (event.named()) return wrong(event, "refers to another field; write the values out");
    if (begins(event.type()) && ++depth_ > kDeepest)
      return wrong(event, "is nested deeper than any calibration");
    if (ends(event.type())) --depth_;
    return {};
  }

  Result<void> expect(yaml_event_type_t type) {
    Event event;
    RELIEVO_TRY(next(event));
    if (event.type() == type) return {};
    if (type == YAML_STREAM_END_EVENT)
      return wrong(event, "a second document follows; give one calibration a file");
    return wrong(event, "not of the form `name: value`; the file is damaged or no calibration");
  }

  Result<void> read_field(const Event& key) {
    if (key.type() != YAML_SCALAR_EVENT || key.text().empty())
      return wrong(key, "not of the form `name: value`; the file is damaged or no calibration");
    const std::string name(key.text());
    if (!seen_.insert(name).second)
      return wrong(key, "this field is there twice; calibrate again or mend the file");
    Event value;
    RELIEVO_TRY(next(value));
    if (value.type() == YAML_MAPPING_START_EVENT) return read_map(name, value);
    if (value.type() == YAML_SEQUENCE_START_EVENT) return skip_rest(depth_ - 1);
    double number = 0;
    if (parse_finite(value, number)) fields_.numbers.emplace(name, number);
    else fields_.words.emplace(name, value.text());
    return {};
  }

  // Up to the end of what began when the depth was `outside`.
  Result<void> skip_rest(int outside) {
    while (depth_ > outside) {
      Event event;
      RELIEVO_TRY(next(event));
    }
    return {};
  }

  // A matrix, or some other map, which is stepped over.
  Result<void> read_map(const std::string& name, const Event& head) {
    const bool must = head.tag().ends_with(":opencv-matrix");
    const int outside = depth_ - 1;
    YamlMatrix matrix;
    bool has_data = false;
    std::set<std::string, std::less<>> seen;
    for (;;) {
      Event key;
      RELIEVO_TRY(next(key));
      if (key.type() == YAML_MAPPING_END_EVENT) break;
      const std::string part(key.type() == YAML_SCALAR_EVENT ? key.text() : std::string_view());
      if (part != "rows" && part != "cols" && part != "dt" && part != "data") {
        if (must) return wrong(key, "a matrix has rows, cols, dt and data only");
        return skip_rest(outside);
      }
      if (!seen.insert(part).second) return wrong(key, "this part of a matrix is there twice; mend the file");
      RELIEVO_TRY(read_part(part, matrix));
      has_data = has_data || part == "data";
    }
    if (!has_data || matrix.rows == 0 || matrix.cols == 0)
      return wrong(head, "this matrix has no rows, no cols or no data; the file was cut short or damaged");
    if (matrix.values.size() != std::size_t(matrix.rows) * std::size_t(matrix.cols))
      return wrong(head, "the data of this matrix are not rows times cols numbers");
    fields_.matrices.emplace(name, std::move(matrix));
    return {};
  }

  Result<void> read_part(const std::string& part, YamlMatrix& matrix) {
    Event value;
    RELIEVO_TRY(next(value));
    if (part == "data") {
      if (value.type() != YAML_SEQUENCE_START_EVENT)
        return wrong(value, "the data of a matrix must be a list of numbers");
      return read_numbers(matrix.values);
    }
    if (value.type() != YAML_SCALAR_EVENT)
      return wrong(value, "rows, cols and dt of a matrix are one word each");
    if (part == "dt") {
      if (value.text() != "d" && value.text() != "f" && value.text() != "i")
        return wrong(value, "the type of a matrix must be d, f or i");
      return {};
    }
    int& side = part == "rows" ? matrix.rows : matrix.cols;
    if (!value.plain() || !parse_whole(value.text(), side) || side < 1 || side > kMostCells)
      return wrong(value, "rows and cols of a matrix must be small whole numbers");
    return {};
  }

  Result<void> read_numbers(std::vector<double>& values) {
    for (;;) {
      Event event;
      RELIEVO_TRY(next(event));
      if (event.type() == YAML_SEQUENCE_END_EVENT) return {};
      double number = 0;
      if (event.type() != YAML_SCALAR_EVENT || !parse_finite(event, number))
        return wrong(event, "a value in this list is no finite number");
      if (values.size() >= kMostCells) return wrong(event, "this list is longer than any of a calibration");
      values.push_back(number);
    }
  }

  std::size_t skipped_;
  yaml_parser_t parser_{};
  bool ready_;
  int depth_ = 0;
  std::set<std::string, std::less<>> seen_;
  YamlFields fields_;
};

}  // namespace

Result<YamlFields> parse_yaml_fields(std::string_view text) {
  if (text.find('\0') != std::string_view::npos)
    return invalid("holds bytes that are no text; give a calibration such as rig.yml");
  const auto last = text.find_last_not_of(" \t\r");
  if (last == std::string_view::npos) return invalid("the calibration is empty; calibrate again");
  // YAML would take the beginning of a number for all of it.
  if (text[last] != '\n' && text[last] != ']' && text[last] != '}')
    return invalid("ends inside a line; the file was cut short, copy it again");
  // OpenCV's first line is no YAML.
  std::size_t skipped = 0;
  if (text.starts_with("%YAML:")) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos)
      return invalid("ends inside a line; the file was cut short, copy it again");
    text.remove_prefix(end + 1);
    skipped = 1;
  }
  return Reader(text, skipped).read();
}

}  // namespace relievo::pipeline
