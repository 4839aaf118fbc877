// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A calibration's YAML as flat fields: top-level numbers and words, and matrices (rows, cols, data and
// perhaps dt), as OpenCV's FileStorage and ROS write them. Other values are stepped over by key.
//
// libyaml reads, by events: nothing is built that a hostile file could make large or deep. What YAML
// lets pass and a calibration must not is refused here: a document that was cut (the last line must be
// ended, or end in a bracket), a field twice, two documents, references, a list of another length than
// rows times cols, a number that is not finite. A number is decimal and the whole of its word.
// Errors: InvalidInput; where() is the line number or the field.
// Thread: any.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"

namespace relievo::pipeline {

struct YamlMatrix {
  int rows = 0;
  int cols = 0;
  std::vector<double> values;  // row-major, rows * cols, all finite
};

struct YamlFields {
  std::map<std::string, double, std::less<>> numbers;
  std::map<std::string, std::string, std::less<>> words;
  std::map<std::string, YamlMatrix, std::less<>> matrices;
};

Result<YamlFields> parse_yaml_fields(std::string_view text);

}  // namespace relievo::pipeline
