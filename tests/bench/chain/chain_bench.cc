// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The default chain's products as a file, and how far two such files lie apart: the same pictures on two
// processors, in two builds, with other numbers of threads.
//   chain_bench record FOLDER THREADS FILE    of FOLDER/left.png, right.png, rig.yml
//   chain_bench compare FILE FILE             exit code 0: identical in every byte, 1: not, and how far apart
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "tests/bench/chain/chain_difference.h"

namespace relievo::bench {
namespace {

Result<void> record(const std::filesystem::path& folder, int threads, const std::filesystem::path& file) {
  RELIEVO_TRY_ASSIGN(const ChainRecord made,
                     record_chain({folder / "left.png", folder / "right.png", folder / "rig.yml"}, threads));
  return write_record(file, made);
}

Result<bool> compare(const std::filesystem::path& one, const std::filesystem::path& other) {
  RELIEVO_TRY_ASSIGN(const ChainRecord a, read_record(one));
  RELIEVO_TRY_ASSIGN(const ChainRecord b, read_record(other));
  const ChainDifference difference = between(a, b);
  std::cout << difference.text();
  return difference.identical;
}

int told(const Error& error) {
  std::cerr << "chain_bench: " << error.where() << ": " << error.what.view() << '\n';
  return 1;
}

int run(int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  if (word == "record" && argc == 5 && std::atoi(argv[3]) > 0) {
    const Result<void> done = record(argv[2], std::atoi(argv[3]), argv[4]);
    return done ? 0 : told(done.error());
  }
  if (word == "compare" && argc == 4) {
    const Result<bool> alike = compare(argv[2], argv[3]);
    return alike ? (*alike ? 0 : 1) : told(alike.error());
  }
  std::cerr << "usage: chain_bench record FOLDER THREADS FILE | compare FILE FILE\n";
  return 2;
}

}  // namespace
}  // namespace relievo::bench

int main(int argc, char** argv) { return relievo::bench::run(argc, argv); }
