// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The judging of readings, without a rig; and how reports and pictures show them.
#include "firmware/checks/optical_check.h"

#include <gtest/gtest.h>

#include "firmware/checks/deviation_picture.h"
#include "pipeline/model/vector3.h"

namespace relievo::firmware {
namespace {

TargetReading sphere(const std::string& name, double form_mm, double size_mm) {
  TargetReading r;
  r.name = name;
  r.range_mm = form_mm;
  r.size_mm = size_mm;
  return r;
}

TargetReading flat(const std::string& name, double flatness_mm) {
  TargetReading r;
  r.name = name;
  r.kind = TargetKind::Plate;
  r.range_mm = flatness_mm;
  return r;
}

AcceptanceReport good() {
  AcceptanceReport report;
  report.targets = {sphere("a", 0.3, -0.02), sphere("b", 0.4, 0.01), flat("p", 0.2), flat("q", 0.3)};
  report.spacings = {{"d", 0.01}, {"e", -0.03}};
  return report;
}

constexpr AcceptanceLimits kLimits{0.5, 0.05, 0.05, 0.5};

TEST(Acceptance, EveryMeasureIsJudgedByItsWorstReadingOfEitherSign) {
  const auto lines = good().lines(kLimits);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].where, "b");
  EXPECT_DOUBLE_EQ(lines[1].value_mm, -0.02);
  EXPECT_DOUBLE_EQ(lines[2].value_mm, -0.03);
  EXPECT_EQ(lines[3].where, "q");
  EXPECT_TRUE(good().verdict(kLimits));
}

TEST(Acceptance, OneReadingOverOneLimitFails) {
  for (int k = 0; k < 4; ++k) {
    AcceptanceReport report = good();
    if (k == 0) report.targets[0].range_mm = 0.51;
    if (k == 1) report.targets[1].size_mm = -0.051;
    if (k == 2) report.spacings[0].error_mm = 0.051;
    if (k == 3) report.targets[2].range_mm = 0.51;
    const auto verdict = report.verdict(kLimits);
    ASSERT_FALSE(verdict) << k;
    const char* const where[] = {"probing error, form, a", "probing error, size, b", "sphere spacing, d",
                                 "flatness, p"};
    EXPECT_EQ(verdict.error().where(), where[k]);
  }
}

TEST(Acceptance, WhatWasNotMeasuredIsNotPassed) {
  EXPECT_FALSE(AcceptanceReport{}.verdict(kLimits));
  AcceptanceReport report = good();
  report.targets[0].range_mm = std::nan("");
  EXPECT_FALSE(report.verdict(kLimits));
  std::swap(report.targets[0], report.targets[1]);
  EXPECT_FALSE(report.verdict(kLimits));
}

TEST(Acceptance, TargetsStandInsideTheVolumeTheyAreMeantFor) {
  // As the guideline wants: seven ways for the dumbbell, six for the plate.
  EXPECT_EQ(dumbbell_places().size(), 7U);
  EXPECT_EQ(plate_places().size(), 6U);
  for (const auto& places : {dumbbell_places(), plate_places()})
    for (const TargetPlace& p : places) {
      EXPECT_GE(p.distance_mm, 500);
      EXPECT_LE(p.distance_mm, 650);
    }
}

TEST(Acceptance, PlacesTurnAboutXThenYThenZ) {
  const auto near = [](const pipeline::Vec3d& a, const pipeline::Vec3d& b) {
    return pipeline::distance(a, b) < 1e-9;
  };
  EXPECT_TRUE(near(left_from_target({1, 2, 3, 0, 0, 90}, {10, 0, 0}), {1, 12, 3}));
  EXPECT_TRUE(near(left_from_target({0, 0, 0, 90, 0, 0}, {0, 10, 0}), {0, 0, 10}));
  EXPECT_TRUE(near(left_from_target({0, 0, 0, 0, 90, 0}, {0, 0, 10}), {10, 0, 0}));
  EXPECT_TRUE(near(left_from_target({0, 0, 0, 90, 0, 90}, {10, 10, 0}), {0, 10, 10}));
}

TEST(AcceptanceReport, TheTableAndTheFileSayTheSame) {
  pipeline::CalibrationQuality quality;
  AcceptanceReport report = good();
  const OpticalCheckOptions options;
  std::string table;
  for (const std::string& line : acceptance_table(report, options, quality)) table += line + "\n";
  EXPECT_NE(table.find("sphere spacing"), std::string::npos) << table;
  EXPECT_EQ(table.find("FAIL"), std::string::npos) << table;
  EXPECT_NE(acceptance_json(report, options, quality).find("\"verdict\": \"pass\""), std::string::npos);
  report.spacings[1].error_mm = 5;
  table.clear();
  for (const std::string& line : acceptance_table(report, options, quality)) table += line + "\n";
  EXPECT_NE(table.find("sphere spacing       +5.000 mm"), std::string::npos) << table;
  EXPECT_NE(table.find("FAIL"), std::string::npos) << table;
  EXPECT_NE(acceptance_json(report, options, quality).find("\"verdict\": \"fail\""), std::string::npos);
}

TEST(DeviationPicture, ColoursGoFromBlueOverWhiteToRed) {
  using Rgb = std::array<std::uint8_t, 3>;
  EXPECT_EQ(deviation_colour(0), (Rgb{255, 255, 255}));
  EXPECT_GT(deviation_colour(-1)[2], 150);
  EXPECT_EQ(deviation_colour(-1)[0], 0);
  EXPECT_GT(deviation_colour(1)[0], 150);
  EXPECT_EQ(deviation_colour(7), deviation_colour(1));
  EXPECT_EQ(deviation_colour(-7), deviation_colour(-1));
}

TEST(DeviationPicture, MarksTheRightHalfAndStaysInside) {
  const std::vector<std::uint8_t> grey(3 * 40 * 30, 100);
  DeviationPicture picture(grey, 40, 30, {-5, 10, 20, 99});  // cut to 0..20, 10..30
  picture.mark(7, 12, 1);
  for (const double at : {-1000.0, -1.0, 19.0, 29.0, 1000.0}) picture.mark(at, at, -1);
  const hal::Picture made = picture.finish();
  ASSERT_EQ(made.width_px, 48);
  const auto level = [&](int x, int y, int c) {
    return static_cast<int>(made.bytes[static_cast<std::size_t>(3 * (y * made.width_px + x) + c)]);
  };
  EXPECT_EQ(level(7, 2, 0), 100);
  EXPECT_EQ(level(28 + 7, 2, 1), 0);
  EXPECT_GT(level(28 + 7, 2, 0), 150);
}

}  // namespace
}  // namespace relievo::firmware
