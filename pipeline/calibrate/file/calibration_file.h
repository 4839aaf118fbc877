// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// rig.yml: a calibration as a file, in the form of OpenCV's stereo sample (image_width image_height
// K1 D1 K2 D2 R T; right-from-left, millimetres; 17 digits, so what is read is what was written).
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

Result<StereoCalibration> read_calibration(const std::filesystem::path& file);
Result<StereoCalibration> parse_calibration(std::string_view text);

// Written under a temporary name beside the file, synced and renamed: nobody meets half a file.
Result<void> write_calibration(const std::filesystem::path& file, const StereoCalibration& calibration);
std::string calibration_text(const StereoCalibration& calibration);

// Could a rig of two cameras standing side by side have these numbers? where() names the field.
Result<void> check_calibration(const StereoCalibration& calibration);

}  // namespace relievo::pipeline
