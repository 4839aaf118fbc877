// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All of the dissertation's tables and figures. Figures 6 to 12 are done on the pair given; figure 17 too,
// where that is calibrated. What is left is done on a simulated person, whose truth is known. Thread: worker.
// Errors: Cancelled; those of the virtual rig and of the disk; InvalidInput (no set could rectify the pair).
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "firmware/arguments/command_line.h"
#include "firmware/compare/page/dissertation.h"
#include "firmware/compare/set_run.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

using Simulate = std::function<Result<void>(const SimulateArgs& args, const Path& folder)>;

struct DissertationOrder {
  std::optional<ComparedPair> pair;
  std::vector<NamedSet> rule_sets, face_sets;  // suites.h
  bool whole_view = false;
  double limit_px = 1;
  Path work;  // a folder of its own, for simulated pictures
};

// `at` becomes the name of what is being made.
Result<Dissertation> do_again(const DissertationOrder& order, const Simulate& simulate,
                              std::atomic<const char*>& at, JobControl& control);

}  // namespace relievo::firmware::compare
