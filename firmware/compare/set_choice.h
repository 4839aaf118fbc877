// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From words to sets of algorithms: all start from --algorithms, relief=off (nobody is refused as a picture
// of a face unless --set says so) and --set; then come, in this order, the suites, the sets of files and
// those of the command line. None named: one set, called by its matcher. Errors: NotFound and InvalidInput,
// each with the set's name and the word: a set that cannot be made, two sets of one name, more than
// kMostSets. Thread: main.
#pragma once

#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/compare/suites.h"
#include "firmware/measure/comparison.h"
#include "hal/base/result.h"

namespace relievo::firmware::compare {

inline constexpr std::size_t kMostSets = 64;

Result<std::vector<NamedSet>> choose_sets(const CompareArgs& args);
Result<std::vector<NamedSet>> make_sets(const AlgorithmArgs& base, const std::vector<SetWords>& words);

}  // namespace relievo::firmware::compare
