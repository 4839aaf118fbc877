// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/base/console.h"

#include <gtest/gtest.h>

#include "firmware/report/report.h"

namespace relievo::firmware {
namespace {

TEST(Console, AnErrorIsOneLineWhateverTheFileIsCalled) {
  const Error error = Error{Errc::NotFound, "is not there: check the name"}.at("a\nb\x1b[31m.png");
  EXPECT_EQ(one_line(error), "relievo: a?b?[31m.png: is not there: check the name");
  EXPECT_EQ(one_line(Error{Errc::NotFound, "is not there"}), "relievo: is not there");
}

TEST(Report, HasTheKeysThatScriptsRead) {
  using std::chrono::microseconds;
  Report report;
  report.calibration = "rig.yml";
  report.algorithms = "matcher = refined\nrefined.bending = 0.3\n";
  report.stages = {{"Match", microseconds(1500), 10, 9, 4096}};
  report.total = microseconds(2500);
  report.quality.nose_relief_mm = 21.5;
  report.quality.symmetry_residual_mm = 0.25;
  report.landmarks[static_cast<std::size_t>(pipeline::LandmarkName::Nasion)] = {{0.5F, 1, 2}, 1.5F, true};
  const std::string json = report_json(report);
  for (const char* key : {"\"version\"", "\"calibration\": \"rig.yml\"", "\"matcher\": \"refined\"",
                          "\"stages\"", "\"name\": \"Match\"", "\"ms\": 1.5", "\"in\": 10", "\"out\": 9",
                          "\"arena_peak_bytes\": 4096", "\"total_ms\": 2.5", "\"peak_rss_bytes\"",
                          "\"quality\"", "\"nose_relief_mm\": 21.5", "\"symmetry_residual_mm\": 0.25",
                          "\"nasion\"", "\"at_mm\"", "\"sigma_mm\": 1.5", "\"pogonion\": null"}) {
    EXPECT_NE(json.find(key), std::string::npos) << key << " in " << json;
  }
}

}  // namespace
}  // namespace relievo::firmware
