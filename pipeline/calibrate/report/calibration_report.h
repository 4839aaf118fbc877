// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A calibration for people: one page of HTML that needs nothing beside it, no network and no script, and
// that prints on A4; and the same for programs, as JSON. Verdict, figures with what is good, uncertainty,
// coverage, residuals, every view, the rig from above, all numbers.
// Texts that come from outside (names of files) are escaped. Numbers are written with a point.
// Thread: any; the same input gives the same text.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/calibrate/calibrator.h"

namespace relievo::pipeline {

// What is to be seen of a view. Empty: nothing, the page then shows the corners alone.
struct ViewPictures {
  std::vector<std::byte> left_jpeg;  // small, of the picture's proportions; goes into the page
  std::vector<std::byte> right_jpeg;
  std::string corners_file;  // beside the page, to be looked at in full size
  std::string rectified_file;
};

struct CalibrationReport {
  const CalibratorInput& input;
  const CalibratorOutput& output;
  std::string product;                 // as "Relievo 0.1.0"
  std::string made_at;                 // as "2026-03-14 09:26 UTC"
  std::string source;                  // where the pictures come from
  std::vector<ViewPictures> pictures;  // one a view, or none
};

std::string calibration_report_html(const CalibrationReport& report);
std::string calibration_report_json(const CalibrationReport& report);

}  // namespace relievo::pipeline
