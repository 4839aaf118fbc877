// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Matches made by hand or elsewhere, as a text file. One match a line:
//
//   # left x, left y, disparity, and one standard deviation of the disparity where it is known
//   512.5 300 41.25
//   600, 310.5, 40, 0.2
//
// full-size rectified pixels; blanks, tabs or one comma between numbers; '#' begins a comment; a point as
// decimal sign. A match has one row, so none can leave its epipolar line.
// Errors: NotFound or IoFailed (the file), InvalidInput (a line that is none of the above, a place outside
// the pictures, a sigma that is not positive, more than 4 MiB), each with the file and the line. Thread: any.
#pragma once

#include <memory_resource>
#include <string>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

inline constexpr float kHandSigmaPx = 0.5F;  // what a careful hand reaches

// In the order of the file, which may hold none; cost is 0. Of `windows` no pixel is looked at. `sigma_px` is
// that of matches whose line has none.
Result<std::pmr::vector<Match>> read_match_file(const std::string& path, const RectifiedPair& windows,
                                                float sigma_px, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
