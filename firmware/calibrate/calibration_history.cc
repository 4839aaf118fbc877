// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibration_history.h"

#include <array>
#include <cstdio>

#include "firmware/base/wall_time.h"
#include "hal/base/words.h"

namespace relievo::firmware {
namespace {

// In the order of storage::CalibrationGrade: what nobody knows, then the verdicts in their order.
constexpr std::array kGrades{"-", "pass", "usable", "refuse"};
static_assert(int(storage::CalibrationGrade::Refuse) == 1 + int(pipeline::CalibrationVerdict::Refuse) &&
              kGrades.size() == 1 + std::size_t(storage::CalibrationGrade::Refuse));

std::string number(double value, int decimals) { return value <= 0 ? "-" : decimal(value, decimals); }

}  // namespace

storage::CalibrationFigures figures_of(const pipeline::CalibrationQuality& q) {
  return {static_cast<storage::CalibrationGrade>(1 + int(q.verdict)), q.held_out_epipolar_px,
          q.depth_sigma_mm, q.shape_sigma_mm};
}

std::string history_heading() {
  return "   no  made                  pictures   verdict  pair px  held out  shift px  depth mm  shape mm  baseline mm  used  from";
}

std::string line_of(const storage::CalibrationInfo& c) {
  const std::string size = std::to_string(c.width_px) + "x" + std::to_string(c.height_px);
  char line[200];
  std::snprintf(line, sizeof line, "%c %4u  %s  %-9s  %-7s  %7s  %8s  %8s  %8s  %8s  %11s  %4d  ",
                c.active ? '*' : ' ', c.revision, text_of(c.created_at).c_str(), size.c_str(),
                kGrades[std::size_t(c.figures.grade)], number(c.rms_px, 3).c_str(),
                number(c.figures.held_out_epipolar_px, 3).c_str(), number(c.epipolar_shift_px, 4).c_str(),
                number(c.figures.depth_sigma_mm, 2).c_str(), number(c.figures.shape_sigma_mm, 2).c_str(),
                number(c.baseline_mm, 2).c_str(), c.enrolments);
  return line + c.note;
}

}  // namespace relievo::firmware
