// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The built program with ChArUco boards: photographed under a hand, calibrated from, and printed.
#include <cmath>

#include "pipeline/calibrate/file/calibration_file.h"
#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

class Charuco : public RelievoProcess {};

TEST_F(Charuco, PartlyCoveredBoardsCalibrate) {
  done({"simulate", "board", "--pattern", "charuco", "--cover", "0.3", "-o", "board", "--scale", "0.5",
        "--pairs", "8"});
  const Said said = done({"calibrate", "board", "--pattern", "charuco", "--corners", "10x7", "--square-mm",
                          "20", "-o", "rig.yml"});
  EXPECT_NE(said.out.find("verdict: "), std::string::npos);
  const auto truth = pipeline::read_calibration(here / "board/rig.yml");
  const auto rig = pipeline::read_calibration(here / "rig.yml");
  ASSERT_TRUE(truth && rig);
  const auto baseline = [](const pipeline::StereoCalibration& c) {
    const pipeline::Vec3d& t = c.right_from_left.translation_mm;
    return std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
  };
  EXPECT_NEAR(baseline(*rig), baseline(*truth), 0.1);
  EXPECT_LT(rig->rms_px, 0.05);
}

TEST_F(Charuco, AreNoChessboards) {
  done({"simulate", "board", "--pattern", "chessboard", "-o", "board", "--scale", "0.3", "--pairs", "2"});
  refused({"calibrate", "board", "--pattern", "charuco", "--corners", "10x7", "--square-mm", "20", "-o",
           "rig.yml"},
          "board", "--corners");
}

TEST_F(Charuco, PrintedOrRefused) {
  const Said said = done({"calibrate", "--print-pattern", "charuco", "--corners", "10x7", "--square-mm", "20",
                          "-o", "board.pdf"});
  EXPECT_NE(said.out.find("A4 landscape"), std::string::npos);
  EXPECT_EQ(read_text(here / "board.pdf").rfind("%PDF", 0), 0U);
  done({"calibrate", "--print-pattern", "chessboard", "--corners", "10x7", "--square-mm", "20", "-o",
        "board.svg"});
  refused({"calibrate", "--print-pattern", "chessboard", "--corners", "40x20", "--square-mm", "40", "-o",
           "big.pdf"},
          "1640 x 840 mm", "A0");
  refused({"calibrate", "--print-pattern", "chessboard", "--corners", "10x7", "--square-mm", "20", "-o",
           "board.png"},
          "board.png", ".pdf");
  refused({"calibrate", "--print-pattern", "charuco", "--corners", "10x7", "--square-mm", "20", "--marker-mm",
           "19", "-o", "b.pdf"},
          "--marker-mm");
  refused({"calibrate", "--print-pattern", "charuco", "--corners", "10x7", "--square-mm", "20", "-o",
           "no/such/board.pdf"},
          "no/such");
}

}  // namespace
}  // namespace relievo::test
