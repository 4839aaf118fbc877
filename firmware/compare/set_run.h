// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One set of algorithms on one pair: every step timed, in memory of its own, measured against what is true;
// and the dissertation's tables and figures. Thread: worker.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/arguments/command_line.h"
#include "firmware/compare/page/compare_page.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/measure/comparison.h"
#include "firmware/measure/measurement.h"
#include "firmware/reconstruct/reconstruction.h"
#include "hal/base/result.h"
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

using Simulate = std::function<Result<void>(const SimulateArgs& args, const Path& folder)>;

struct DissertationOrder {
  std::optional<ComparedPair> pair;
  std::vector<NamedSet> rule_sets, face_sets;  // below
  bool whole_view = false;
  double limit_px = 1;
  Path work;  // a folder of its own, for simulated pictures
};

// All of the dissertation's tables and figures. Figures 6 to 12 are done on the pair given; figure 17 too,
// where that is calibrated. What is left is done on a simulated person, whose truth is known. `at` becomes
// the name of what is being made. Errors: Cancelled; those of the virtual rig and of the disk; InvalidInput
// (no set could rectify the pair).
Result<Dissertation> do_again(const DissertationOrder& order, const Simulate& simulate,
                              std::atomic<const char*>& at, JobControl& control);

// Sets that belong together, by name. A suite is made from the algorithms that this program has; that of the
// dissertation is more than sets: do_again() makes a report of its own of it.
// Errors: NotFound (no such suite; the error's place lists them). Thread: any.
inline constexpr std::string_view kDissertation = "dissertation";

// Figures 6 to 12 (Bardsley 2004): SSD, ZMNCC, ZMNCC with the first rule, with the first two and so on, and
// last what is the default here.
std::vector<SetWords> dissertation_rule_sets();
// Figure 17, the fully automatic face: the chain as it was then, dense and at chosen places, and ours.
std::vector<SetWords> dissertation_face_sets();

// From words to sets of algorithms: all start from --algorithms, relief=off (nobody is refused as a picture
// of a face unless --set says so) and --set; then come, in this order, the suites, the sets of files and
// those of the command line. None named: one set, called by its matcher. Errors: NotFound and InvalidInput,
// each with the set's name and the word: a set that cannot be made, two sets of one name, more than
// kMostSets. Thread: main.
inline constexpr std::size_t kMostSets = 64;

Result<std::vector<NamedSet>> choose_sets(const CompareArgs& args);
Result<std::vector<NamedSet>> make_sets(const AlgorithmArgs& base, const std::vector<SetWords>& words);

}  // namespace relievo::firmware::compare
