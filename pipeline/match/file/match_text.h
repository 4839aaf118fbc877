// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Matches made by hand or elsewhere, as text. One match a line (number_lines.h):
//
//   # left x, left y, disparity, and one standard deviation of the disparity where it is known
//   512.5 300 41.25
//   600, 310.5, 40, 0.2
//
// full-size rectified pixels. A match has one row, so none can leave its epipolar line. Errors: InvalidInput
// with file and line (not three or four numbers, a place outside the pictures, a sigma that is not positive);
// std::bad_alloc passes. Thread: any.
#pragma once

#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

inline constexpr float kHandSigmaPx = 0.5F;  // what a careful hand reaches

// In the order of the text, which may hold none; cost is 0. `file` is for the errors. Of `windows` no pixel
// is looked at. `sigma_px` is that of matches whose line has none.
Result<std::pmr::vector<Match>> matches_in(std::string_view text, const std::string& file,
                                           const RectifiedPair& windows, float sigma_px,
                                           std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
