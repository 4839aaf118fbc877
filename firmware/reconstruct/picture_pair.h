// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PicturePair: the two pictures of one instant, read from files; and the calibration they are for.
// Errors: the reader's; InvalidInput where the sizes differ from each other or from the calibration.
// Each names the file. Thread: any.
#pragma once

#include <filesystem>
#include <string>

#include "hal/camera.h"
#include "hal/picture_file.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

struct PicturePair {
  hal::Picture left, right;
  pipeline::StereoFrame frame() const { return {left.view(), right.view(), 0, 0}; }
};

Result<PicturePair> read_pair(const std::filesystem::path& left, const std::filesystem::path& right);

// Is it for pictures this large? `place` is named where it is not.
Result<void> check_size(const pipeline::StereoCalibration& calibration, const hal::CaptureMode& pictures,
                        const std::string& place);

// Of pictures this large; a calibration that does not say for which it is (OpenCV's sample) is taken for
// these. `left` is named where it is not.
Result<pipeline::StereoCalibration> read_calibration_for(const PicturePair& pair,
                                                         const std::filesystem::path& file,
                                                         const std::filesystem::path& left);

}  // namespace relievo::firmware
