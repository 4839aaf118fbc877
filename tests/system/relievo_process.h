// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The built program in a folder of its own, for tests of what a person meets.
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/small_device.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {

class RelievoProcess : public testing::Test {
 protected:
  Said relievo(std::vector<std::string> words) {
    words.insert(words.begin(), RELIEVO_BINARY);
    return run_program(words, here.path());
  }
  // It must be done, and say nothing on standard error.
  Said done(const std::vector<std::string>& words) {
    Said said = relievo(words);
    EXPECT_EQ(said.exit_code, 0) << said.err;
    EXPECT_EQ(said.err, "");
    return said;
  }
  // `folder` as `relievo simulate` makes it by these words: the same for all tests and builds, so it is made
  // once where there is an album.
  void simulated(std::vector<std::string> words, const std::string& folder) {
    std::string name = "simulate";
    for (const std::string& word : words) name += " " + word;
    words.insert(words.begin(), "simulate");
    words.insert(words.end(), {"-o", folder});
    if (album_folder().empty()) {
      done(words);
      return;
    }
    const std::filesystem::path kept = album_folder() / name;
    if (!std::filesystem::exists(kept)) {
      // Whoever else makes it at the same time makes the same.
      const std::filesystem::path begun = kept.string() + " " + std::to_string(getpid());
      words.back() = begun;
      done(words);
      std::error_code first;
      std::filesystem::rename(begun, kept, first);
      if (first) std::filesystem::remove_all(begun);
    }
    std::filesystem::copy(kept, here / folder, std::filesystem::copy_options::recursive);
  }
  // It must refuse: exit code 1, one line that names the place and the trouble, and nothing written.
  void refused(const std::vector<std::string>& words, const std::string& place,
               const std::string& trouble = "") {
    // A store that was opened to write has no log of SQLite's beside it when it is closed; readers leave one.
    const auto files = [this] {
      return std::regex_replace(listing(here.path()), std::regex("[^\n]*/relievo\\.db-(shm|wal)\n"), "");
    };
    const std::string before = files();
    const Said said = relievo(words);
    std::string call;
    for (const std::string& word : words) call += word + " ";
    EXPECT_EQ(said.exit_code, 1) << call << "\n" << said.out << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << call << "\n" << said.err;
    EXPECT_EQ(said.err.rfind("relievo: ", 0), 0U) << call << "\n" << said.err;
    EXPECT_NE(said.err.find(place), std::string::npos) << call << "\n" << said.err;
    EXPECT_NE(said.err.find(trouble), std::string::npos) << call << "\n" << said.err;
    EXPECT_EQ(files(), before) << call;
  }

  TemporaryFolder here;
};

}  // namespace relievo::test
