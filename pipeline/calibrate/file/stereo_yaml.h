// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenCV's stereo YAML: cameras and relation in one document, or in the two of its stereo sample.
// Inside file/ only. Errors: InvalidInput (the field in where()), Unsupported. Thread: any.
#pragma once

#include <string>

#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/file/yaml_fields.h"

namespace relievo::pipeline {

bool has_stereo_cameras(const YamlFields& fields);   // K1, M1 or cameraMatrix1
bool has_stereo_relation(const YamlFields& fields);  // R and T

// The same fields twice where one document holds both. Not yet checked.
Result<StereoCalibration> read_stereo_yaml(const YamlFields& cameras, const YamlFields& relation,
                                           const CalibrationHints& hints);

}  // namespace relievo::pipeline
