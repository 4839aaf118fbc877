// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A calibration as files: our own rig.yml, and what other tools write.
//
//   rig.yml                        OpenCV's stereo YAML: image_width image_height K1 D1 K2 D2 R T (M1 or
//                                  cameraMatrix1, distCoeffs1 too), right from left, millimetres; 17
//                                  digits, so what is read is what was written; left_camera and
//                                  right_camera name the cameras it was made with, where they are known
//   intrinsics.yml extrinsics.yml  the two files of OpenCV's stereo sample; they do not say how large the
//                                  pictures are
//   left.yaml right.yaml           ROS camera_info, metres
//
// OpenCV's own reader takes wrong numbers from a file that was cut short (0.21 becomes 2.1). This
// one takes a whole document or nothing: every field once, every list closed, every number inside
// the range of a real rig.
// Errors: NotFound, IoFailed, MediaFull; InvalidInput with the file and field in where(); Unsupported
// for a camera model with more than five distortion coefficients.
// Thread: any.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline {

// A rig.yml of ours has 2 kB; OpenCV's with every by-product less than 20.
inline constexpr std::size_t kMaxCalibrationFileBytes = 256 * 1024;

// What the files may leave open.
struct CalibrationHints {
  int width_px = 0;  // of the pictures, where the file does not say; 0: it must say
  int height_px = 0;
  double unit_mm = 0;  // of the translation; 0: the form's own, 1 for OpenCV's and 1000 for ROS
};

// Where `file` is one of a pair, the other is looked for beside it, by its name (left and right,
// intrinsics and extrinsics), unless it is named.
Result<StereoCalibration> read_calibration(const std::filesystem::path& file,
                                           const CalibrationHints& hints = {},
                                           const std::filesystem::path& other = {});
Result<StereoCalibration> parse_calibration(std::string_view text, const CalibrationHints& hints = {});
// The two files of a pair, in either order.
Result<StereoCalibration> parse_calibration_pair(std::string_view one, std::string_view other,
                                                 const CalibrationHints& hints = {});

// rig.yml, written under a temporary name beside the file, synced and renamed: nobody meets half a file.
Result<void> write_calibration(const std::filesystem::path& file, const StereoCalibration& calibration);
std::string calibration_text(const StereoCalibration& calibration);

// ROS's left.yaml and right.yaml.
struct CameraInfoTexts {
  std::string left;
  std::string right;
};

// Errors: those of lay_windows(): the cameras do not look at a common volume.
Result<CameraInfoTexts> camera_info_texts(const StereoCalibration& calibration);

// Could a rig of two cameras standing side by side have these numbers? where() names the field.
Result<void> check_calibration(const StereoCalibration& calibration);

}  // namespace relievo::pipeline
