// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ROS camera_info: one YAML file a camera, as camera_calibration writes left.yaml and right.yaml
// (sensor_msgs/CameraInfo, http://wiki.ros.org/image_pipeline/CameraInfo).
//
// How the cameras stand to each other is in the rectification: with R1, R2 the rectification matrices
// and Tx = P2(0,3) / P2(0,0), which is minus the baseline, in metres,
//   right_from_left = R2^T R1,   translation = R2^T (Tx, 0, 0) * 1000 mm.
// What is written here rectifies as rectifier.h does (the x axis is the baseline, the z axis
// lies between the two optical axes), with the pictures' own size and a principal point of its own for
// each camera: toed-in cameras would otherwise look past each other. image_proc and image_geometry's
// StereoCameraModel take both into account.
// ROS has no field for how good a calibration is: rms_px and epipolar_shift_px are not kept; nor are the
// cameras' names. Errors: InvalidInput (the field in where()), Unsupported (another lens model). Thread: any.
#pragma once

#include <string>

#include "pipeline/calibrate/file/calibration_file.h"
#include "pipeline/calibrate/file/yaml_fields.h"

namespace relievo::pipeline {

bool is_camera_info(const YamlFields& fields);

// In either order: the right camera is the one that stands away from the origin. Not yet checked.
Result<StereoCalibration> read_camera_infos(const YamlFields& one, const YamlFields& other,
                                            const CalibrationHints& hints);

struct CameraInfoTexts {
  std::string left;
  std::string right;
};

// Errors: those of lay_windows(): the cameras do not look at a common volume.
Result<CameraInfoTexts> camera_info_texts(const StereoCalibration& calibration);

}  // namespace relievo::pipeline
