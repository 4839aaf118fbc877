// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ComparedPair: two pictures, how to rectify them, and what is known to be true of them.
// Errors: those of the files, each with its name; InvalidInput where sizes do not fit. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/measure/disparity_truth.h"
#include "firmware/measure/triangle_grid.h"
#include "firmware/reconstruct/picture_pair.h"
#include "pipeline/match/rectify/given_pair.h"

namespace relievo::firmware::compare {

struct ComparedPair {
  std::string name;
  PicturePair pictures;
  std::optional<pipeline::StereoCalibration> calibration;  // none: rectified already
  pipeline::DisparityRange range;                          // of a rectified pair
  std::optional<DisparityTruth> disparities;               // from a file
  std::optional<measure::TruthView> view;                  // from the simulated rig
  std::optional<measure::Surface> head;
};

Result<std::vector<ComparedPair>> read_pairs(const CompareArgs& args);

}  // namespace relievo::firmware::compare
