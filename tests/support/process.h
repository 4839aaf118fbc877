// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a program as a person would: words in, exit code and what it said out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace relievo::test {

struct Said {
  int exit_code = -1;  // 128 + signal where it was killed
  std::string out;
  std::string err;
};

// Waits for the end. The folder is where it runs.
Said run_program(const std::vector<std::string>& words, const std::filesystem::path& folder);
// Sends the signal as soon as standard output or error holds `until`, or at once where that is empty.
Said run_program_and_signal(const std::vector<std::string>& words, const std::filesystem::path& folder,
                            int signal, const std::string& until);

}  // namespace relievo::test
