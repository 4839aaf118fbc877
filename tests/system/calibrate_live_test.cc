// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The built program calibrating live: photographs shown as pairs, a hand that is interrupted, bad input.
#include <csignal>

#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

class CalibrateLiveProcess : public RelievoProcess {
 protected:
  static std::vector<std::string> live(const std::string& board) {
    return {"calibrate", "--live",      "--board", board, "--corners",
            "10x7",      "--square-mm", "20",      "-o",  "rig.yml"};
  }
};

TEST_F(CalibrateLiveProcess, PhotographsGiveACalibrationThatIsStored) {
  done({"simulate", "board", "-o", "board", "--scale", "0.25", "--pairs", "8"});
  auto words = live("folder:board");
  words.insert(words.end(), {"--store", "store"});
  const Said said = done(words);
  EXPECT_NE(said.out.find(": taken as view 5, predicted error "), std::string::npos) << said.out;
  EXPECT_NE(said.out.find(" pairs a second"), std::string::npos);
  EXPECT_NE(said.out.find("verdict: "), std::string::npos);
  EXPECT_NE(said.out.find("stored: calibration 1"), std::string::npos);
  const auto truth = pipeline::read_calibration(here / "board/rig.yml");
  const auto rig = pipeline::read_calibration(here / "rig.yml");
  ASSERT_TRUE(truth && rig);
  EXPECT_NEAR(rig->left.focal_px.x, truth->left.focal_px.x, 0.003 * truth->left.focal_px.x);
  EXPECT_NEAR(rig->right_from_left.translation_mm.x, truth->right_from_left.translation_mm.x, 0.3);
}

TEST_F(CalibrateLiveProcess, BadInputIsRefusedInOneLine) {
  refused(live("window"), "window", "folder:DIR");
  refused(live("folder:missing"), "missing");
  auto nowhere = live("sim");
  nowhere.back() = "no/such/rig.yml";
  refused(nowhere, "no/such");
}

TEST_F(CalibrateLiveProcess, InterruptedItWritesNothing) {
  auto words = live("sim");
  words.insert(words.begin(), RELIEVO_BINARY);
  const std::string before = listing(here.path());
  const Said said = run_program_and_signal(words, here.path(), SIGINT, "pair 2");
  EXPECT_EQ(said.exit_code, 1) << said.err;
  EXPECT_NE(said.err.find("cancelled"), std::string::npos) << said.err;
  EXPECT_EQ(listing(here.path()), before);
}

}  // namespace
}  // namespace relievo::test
