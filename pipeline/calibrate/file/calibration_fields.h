// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts that every form of a calibration file shares. Inside file/ only.
// Errors: InvalidInput and Unsupported, the field in where(). Thread: any.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/calibrate/file/calibration_file.h"

namespace relievo::pipeline {

// A calibration's YAML as flat fields: top-level numbers and words, and matrices (rows, cols, data and
// perhaps dt), as OpenCV's FileStorage and ROS write them. Other values are stepped over by key.
//
// libyaml reads, by events: nothing is built that a hostile file could make large or deep. What YAML
// lets pass and a calibration must not is refused here: a document that was cut (the last line must be
// ended, or end in a bracket), a field twice, two documents, references, a list of another length than
// rows times cols, a number that is not finite. A number is decimal and the whole of its word.
// Errors: InvalidInput; where() is the line number or the field.
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

inline Error wrong(Literal what, std::string_view field) { return invalid(what).at(field); }

// One thing's names in different tools, the usual one first.
using FieldNames = std::array<std::string_view, 3>;

// Is any of them there?
bool holds(const YamlFields& fields, const FieldNames& names);

// Of exactly this size, under exactly one of its names.
Result<const YamlMatrix*> find_matrix(const YamlFields& fields, const FieldNames& names, int rows, int cols);

// image_width and image_height, or the hints; a size that is only hinted at must have the principal
// point near its middle (check_hinted_size).
Result<void> read_size(const YamlFields& fields, const CalibrationHints& hints, CameraIntrinsics& camera);
Result<void> check_hinted_size(const CameraIntrinsics& camera, std::string_view name);

Result<void> read_camera_matrix(const YamlFields& fields, const FieldNames& names, CameraIntrinsics& camera);

// Orthonormal, no mirror, no turn by more than a right angle.
Result<void> check_rotation(const Rotation& rotation, std::string_view name);

// k1 k2 p1 p2 and perhaps k3; more are taken only as zeros.
Result<void> read_distortion(const YamlFields& fields, const FieldNames& names, CameraIntrinsics& camera);

}  // namespace relievo::pipeline
