// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DisparityTruth: what a pair's disparities truly are, and which pixels of the left view the right one sees.
//   a picture, PNG: grey value / scale; 0 is unknown (Middlebury 2001 to 2006)
//   a PFM: float32, one channel, either byte order; infinite or NaN is unknown (Middlebury 2014)
//   a folder of the simulated rig (measure::TruthView): depth, brought into the rectified view
// Errors: NotFound, IoFailed, InvalidInput, each with the file. Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware/measure/disparity_map.h"
#include "firmware/measure/truth_view.h"
#include "hal/base/result.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::firmware::compare {

struct DisparityTruth {
  DisparityMap map;
  std::vector<std::uint8_t> seen;  // 1: known, and nothing nearer hides it from the right view
};

Result<DisparityTruth> read_disparity_truth(const std::filesystem::path& file, double scale);

// Rectified views come from `view`'s left picture; only skin of the face that is judged is known.
DisparityTruth truth_of_view(const measure::TruthView& view, const pipeline::RectifiedPair& pair);

// Which pixels the right view sees, from the disparities themselves.
std::vector<std::uint8_t> seen_by_both(const DisparityMap& map);

}  // namespace relievo::firmware::compare
