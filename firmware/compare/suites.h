// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sets that belong together, by name. A suite is made from the algorithms that this program has; that of the
// dissertation is more than sets: set_run.h makes a report of its own of it.
// Errors: NotFound (no such suite; the error's place lists them). Thread: any.
#pragma once

#include <string_view>
#include <vector>

#include "firmware/arguments/algorithm_choice.h"
#include "firmware/arguments/command_line.h"
#include "firmware/measure/comparison.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

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
