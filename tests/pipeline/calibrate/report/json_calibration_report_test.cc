// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/report/reported_set.h"

namespace relievo::tests {
namespace {

TEST(CalibrationReportJson, KeepsTheKeysThatScriptsKnow) {
  ReportedSet set;
  const auto json = nlohmann::json::parse(pipeline::calibration_report_json(set.report()));
  for (const char* key : {"verdict",
                          "reasons",
                          "views_used",
                          "views_given",
                          "pair_rms_px",
                          "left_rms_px",
                          "right_rms_px",
                          "epipolar_rms_px",
                          "held_out_epipolar_px",
                          "coverage_left",
                          "coverage_right",
                          "holds_still",
                          "slip_ratio",
                          "slip_cause",
                          "moved_after",
                          "moved_after_first",
                          "moved_after_last",
                          "baseline_mm",
                          "expected_baseline_mm",
                          "tilt_spread_deg",
                          "board_sag_mm",
                          "board_sag_sigma_mm",
                          "board_bent",
                          "working_distance_mm",
                          "depth_sigma_mm",
                          "face_depth_sigma_mm",
                          "shape_sigma_mm",
                          "uncertainty",
                          "views"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"name", "used", "reason", "left_rms_px", "right_rms_px", "epipolar_rms_px",
                          "excess_px", "corners_dropped", "distance_mm", "tilt_deg"})
    EXPECT_TRUE(json["views"][0].contains(key)) << key;
}

TEST(CalibrationReportJson, HoldsWhatThePageShows) {
  ReportedSet set;
  const auto json = nlohmann::json::parse(pipeline::calibration_report_json(set.report()));
  const pipeline::StereoCalibration& c = set.output.calibration;
  const auto& u = set.output.quality.uncertainty.parameters;
  EXPECT_EQ(json["product"], "Relievo 1.2.3");
  EXPECT_EQ(json["made_at"], "2026-03-14 09:26 UTC");
  EXPECT_EQ(json["board"]["columns"], 9);
  EXPECT_EQ(json["calibration"]["left"]["focal_px"][1], c.left.focal_px.y);
  EXPECT_EQ(json["calibration"]["right"]["distortion"][4], c.right.distortion[4]);
  EXPECT_EQ(json["calibration"]["right"]["distortion_sigma"][4], u.lens[1][8]);
  EXPECT_EQ(json["calibration"]["right_from_left"]["rotation"][2], c.right_from_left.rotation.m[2]);
  EXPECT_EQ(json["calibration"]["right_from_left"]["translation_sigma_mm"][0], u.translation_mm[0]);
  EXPECT_EQ(json["views"][12]["name"], kWickedName);
  EXPECT_EQ(json["views"][13]["name"], "caf\xEF\xBF\xBD");
  EXPECT_EQ(json["views"][0]["left_from_board"]["translation_mm"][2],
            set.output.views[0].left_from_board.translation_mm.z);
  const auto& residuals = json["views"][2]["right_residuals_px"];
  ASSERT_EQ(residuals.size(), 54U);
  EXPECT_TRUE(residuals[7].is_null()) << "a stray was dropped";
  EXPECT_NEAR(residuals[8][0].get<double>(), set.output.views[2].right[8].at.x, 1e-4);
  EXPECT_NEAR(residuals[8][3].get<double>(), set.output.views[2].right[8].off.y, 1e-4);
  EXPECT_TRUE(json["views"][5]["left_residuals_px"].empty()) << "no board in left";
}

}  // namespace
}  // namespace relievo::tests
