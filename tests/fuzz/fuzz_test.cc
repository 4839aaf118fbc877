// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of hostile input, with any compiler: the seeds, what was found (corpus/TARGET/), every length
// of a seed, and some hundred changes of each.
#include <gtest/gtest.h>

#include <random>

#include "tests/fuzz/fuzz_targets.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {

void PrintTo(const FuzzTarget& target, std::ostream* out) { *out << target.name; }

namespace {

FuzzBytes of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

class Fuzz : public ::testing::TestWithParam<FuzzTarget> {
 protected:
  std::vector<std::string> corpus() const {
    std::vector<std::string> all;
    const std::filesystem::path folder = std::filesystem::path(RELIEVO_FUZZ_CORPUS) / GetParam().name;
    if (!std::filesystem::exists(folder)) return all;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      all.push_back(read_text(entry.path()));
    return all;
  }
};

TEST_P(Fuzz, SeedsAreTaken) {
  ASSERT_FALSE(GetParam().seeds.empty());
  for (const std::string& seed : GetParam().seeds)
    EXPECT_TRUE(GetParam().run(of(seed))) << seed.substr(0, 80);
}

TEST_P(Fuzz, WhatWasFoundDoesNoHarm) {
  for (const std::string& input : corpus()) (void)GetParam().run(of(input));
}

TEST_P(Fuzz, SeedsCutAndChangedDoNoHarm) {
  const bool slow = GetParam().name == "store";  // each is a store that is opened
  std::mt19937 random(3);
  const int changes = slow ? 40 : 300;
  int refused = 0;
  for (const std::string& seed : GetParam().seeds) {
    const std::size_t step = 1 + seed.size() / 300;
    for (std::size_t size = 0; size < seed.size(); size += step)
      refused += GetParam().run(of(seed.substr(0, size))) ? 0 : 1;
    for (int i = 0; i < changes; ++i) {
      std::string input = seed;
      // As patched() takes it.
      for (int n = seed.empty() ? 400 : 0; n > 0; --n) input += static_cast<char>(random());
      for (unsigned n = 1 + random() % 4; n > 0; --n) {
        const std::size_t at = random() % (input.size() + 1);
        if (random() % 2 == 0 && at < input.size()) input[at] = static_cast<char>(random());
        else input.insert(at, 1 + random() % 8, static_cast<char>(random()));
      }
      refused += GetParam().run(of(input)) ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 0) << "takes everything";
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, ::testing::ValuesIn(fuzz_targets()), [](const auto& target) {
  std::string name = target.param.name;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace relievo::test
