// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calibrations on a stick, in both forms: calibrations/NAME/ with rig.yml (OpenCV's) and left.yaml,
// right.yaml (ROS), read back before the folder gets its name; then the stick is let go. Taken from a stick
// is what lies at its top, else in the folder of calibrations whose name comes last; of the two forms
// rig.yml, which says more. Thread: keeper. Errors: MediaMissing (no stick), NotFound (no calibration on it),
// Disconnected (pulled out meanwhile), MediaFull, IoFailed; those of pipeline/calibrate/file.
#pragma once

#include <string>

#include "hal/removable_media.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware {

inline constexpr const char* kCalibrationsFolder = "calibrations";  // on the stick

Result<void> export_calibration(const pipeline::StereoCalibration& calibration, const std::string& name,
                                hal::RemovableMedia& media);

struct StickCalibration {
  pipeline::StereoCalibration calibration;
  std::string file;  // from the stick's top
};
Result<StickCalibration> import_calibration(hal::RemovableMedia& media);

}  // namespace relievo::firmware
