// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every algorithm of a kind, as the tables name them: contract tests run over these, and one made by its
// name.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/algorithms.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {

inline std::vector<std::string> names_of(std::string_view kind) {
  std::vector<std::string> names;
  for (const pipeline::OptionDescription& option : pipeline::describe_algorithms())
    if (option.key == kind) names = option.names;
  std::erase(names, "none");
  return names;
}

using Settings = std::vector<std::pair<std::string, std::string>>;

// `which` is the member of that kind. Files that options name are read.
template <typename Form>
Form made(Form pipeline::Algorithms::*which, const char* kind, const std::string& name,
          const Settings& settings = {}) {
  pipeline::AlgorithmSet set;
  EXPECT_TRUE(set.set(kind, name));
  for (const auto& [key, value] : settings) {
    EXPECT_TRUE(set.set(key, value)) << key;
    if (key.ends_with(".path") && !value.empty()) set.keep_text(key, read_text(value));
  }
  auto all = pipeline::make_algorithms(set);
  EXPECT_TRUE(all) << name;
  return std::move((*all).*which);
}

// A test's name may hold letters and digits only.
inline std::string test_name(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace relievo::test
