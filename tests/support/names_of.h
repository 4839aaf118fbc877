// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every algorithm of a kind, as the tables name them: contract tests run over these.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/algorithms.h"

namespace relievo::test {

inline std::vector<std::string> names_of(std::string_view kind) {
  std::vector<std::string> names;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms())
    if (option.key == kind) names = option.names;
  std::erase(names, "none");
  return names;
}

// A test's name may hold letters and digits only.
inline std::string test_name(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace relievo::test
