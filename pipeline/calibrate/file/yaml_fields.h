// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of YAML that OpenCV's FileStorage writes, read strictly: top-level `key: scalar` and
// `key: !!opencv-matrix` with rows, cols, dt and data. Other indented values are skipped by key, but
// brackets and line ends must be whole there too.
// Errors: InvalidInput; where() is the line number or the field.
#pragma once

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
  std::map<std::string, YamlMatrix, std::less<>> matrices;
};

Result<YamlFields> parse_yaml_fields(std::string_view text);

}  // namespace relievo::pipeline
