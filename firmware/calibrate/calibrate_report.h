// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The folder that `relievo calibrate --report DIR` writes: index.html for people, report.json for
// programs, and of each pair a picture with its corners and one with both views rectified.
// Thread: main.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "firmware/calibrate/calibrate_command.h"

namespace relievo::firmware {

// Whole or not at all. One line a pair goes to `out`.
// Errors: the pictures' (they are read once more), the disk's; each names its place.
Result<void> write_calibration_report(const Path& folder, const std::vector<PicturePairFiles>& pairs,
                                      const pipeline::CalibratorInput& input,
                                      const pipeline::CalibratorOutput& result, const std::string& made_at,
                                      std::ostream& out);

}  // namespace relievo::firmware
