// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts that every form of a calibration file shares. Inside file/ only.
// Errors: InvalidInput and Unsupported, the field in where(). Thread: any.
#pragma once

#include <string_view>

#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/file/yaml_fields.h"

namespace relievo::pipeline {

inline Error wrong(Literal what, std::string_view field) { return Error{Errc::InvalidInput, what}.at(field); }

// One thing's names in different tools.
struct FieldNames {
  std::string_view usual;
  std::string_view second = {};
  std::string_view third = {};
};

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
