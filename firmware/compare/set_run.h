// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One set of algorithms on one pair: every step timed, in memory of its own, measured against what is true.
// Thread: worker.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/measure/comparison.h"
#include "firmware/measure/disparity_map.h"
#include "firmware/measure/triangle_grid.h"
#include "firmware/reconstruct/picture_pair.h"
#include "hal/base/thread_pool.h"
#include "pipeline/match/rectify/rectifier.h"
#include "pipeline/model/face_model.h"

namespace relievo::firmware::compare {

// ComparedPair: two pictures, how to rectify them, and what is known to be true of them.
// Errors: those of the files, each with its name; InvalidInput where sizes do not fit. Thread: any.
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

struct RunOptions {
  bool whole_view = false;
  double limit_px = 1;
  bool models = true;  // of calibrated pairs; else only their matches
  // Called with a model while the memory it lies in stands; may be empty.
  std::function<Result<void>(const pipeline::FaceModel&)> keep_model{};
};

// Every set on every pair. A set that fails on a pair is a run that says why. `at` becomes the number of the
// run that is being made. Errors: Cancelled; those of `keep_model`.
Result<Comparison> compare_sets(std::vector<ComparedPair> pairs, std::vector<NamedSet> sets,
                                const RunOptions& options, std::atomic<std::size_t>& at, JobControl& control);

}  // namespace relievo::firmware::compare
