// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The optical self-test as a person meets it: a table, files, an exit code.
#include <csignal>
#include <filesystem>

#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;

class OpticalSelfTest : public RelievoProcess {};

TEST_F(OpticalSelfTest, PassesOnTheSimulatedRigAndWritesWhatItSaw) {
#ifdef RELIEVO_SANITIZED
  GTEST_SKIP() << "minutes with sanitizers; firmware.OpticalCheck runs its parts there";
#endif
  const Said said = done({"selftest", "--optical", "--scale", "0.5", "-o", "out"});
  for (const char* measure : {"probing error, form", "probing error, size", "sphere spacing", "flatness",
                              "calibrated on 14 of 14 boards"})
    EXPECT_NE(said.out.find(measure), std::string::npos) << said.out;
  EXPECT_EQ(said.out.find("FAIL"), std::string::npos) << said.out;
  const std::string report = read_text(here / "out/report.json");
  EXPECT_NE(report.find("\"verdict\": \"pass\""), std::string::npos);
  EXPECT_NE(report.find("\"points_discarded\""), std::string::npos);
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(here / "out"))
    pictures += entry.path().extension() == ".png" ? 1 : 0;
  EXPECT_EQ(pictures, 2 * 7 + 6);
}

TEST_F(OpticalSelfTest, SaysAtOnceWhereItCannotWrite) {
  write_text(here / "file", "taken");
  refused({"selftest", "--optical", "-o", "file"}, "file");
}

TEST_F(OpticalSelfTest, ItsWordsNeedItsName) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"selftest", "-o", "out"},
                                             {"selftest", "--seed", "3"},
                                             {"selftest", "--optical", "--scale", "0.2"},
                                             {"selftest", "--optical", "--scale", "2"}}) {
    const Said said = relievo(words);
    EXPECT_EQ(said.exit_code, 2) << said.out << said.err;
    EXPECT_EQ(std::count(said.err.begin(), said.err.end(), '\n'), 1) << said.err;
  }
}

TEST_F(OpticalSelfTest, ControlCLeavesNothing) {
  const Said said =
      run_program_and_signal({RELIEVO_BINARY, "selftest", "--optical", "--scale", "0.5", "-o", "out"},
                             here.path(), SIGINT, "boards");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_NE(said.err.find("cancelled"), std::string::npos) << said.err;
  EXPECT_EQ(listing(here.path()), "");
}

}  // namespace
}  // namespace relievo::test
