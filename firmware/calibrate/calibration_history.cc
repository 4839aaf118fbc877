// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/calibrate/calibration_history.h"

#include <cstdio>

#include "firmware/base/wall_time.h"

namespace relievo::firmware {
namespace {

storage::CalibrationGrade grade_of(pipeline::CalibrationVerdict verdict) {
  switch (verdict) {
    case pipeline::CalibrationVerdict::Pass: return storage::CalibrationGrade::Pass;
    case pipeline::CalibrationVerdict::Usable: return storage::CalibrationGrade::Usable;
    case pipeline::CalibrationVerdict::Refuse: return storage::CalibrationGrade::Refuse;
  }
  return storage::CalibrationGrade::Unknown;
}

const char* word(storage::CalibrationGrade grade) {
  switch (grade) {
    case storage::CalibrationGrade::Pass: return "pass";
    case storage::CalibrationGrade::Usable: return "usable";
    case storage::CalibrationGrade::Refuse: return "refuse";
    case storage::CalibrationGrade::Unknown: break;
  }
  return "-";
}

std::string number(double value, int decimals) {
  if (value <= 0) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

}  // namespace

storage::CalibrationFigures figures_of(const pipeline::CalibrationQuality& q) {
  return {grade_of(q.verdict), q.held_out_epipolar_px, q.depth_sigma_mm, q.shape_sigma_mm};
}

std::string history_heading() {
  return "   no  made                  pictures   verdict  pair px  held out  shift px  depth mm  shape mm  baseline mm  used  from";
}

std::string line_of(const storage::CalibrationInfo& c) {
  const std::string size = std::to_string(c.width_px) + "x" + std::to_string(c.height_px);
  char line[200];
  std::snprintf(line, sizeof line, "%c %4u  %s  %-9s  %-7s  %7s  %8s  %8s  %8s  %8s  %11s  %4d  ",
                c.active ? '*' : ' ', c.revision, text_of(c.created_at).c_str(), size.c_str(),
                word(c.figures.grade), number(c.rms_px, 3).c_str(),
                number(c.figures.held_out_epipolar_px, 3).c_str(), number(c.epipolar_shift_px, 4).c_str(),
                number(c.figures.depth_sigma_mm, 2).c_str(), number(c.figures.shape_sigma_mm, 2).c_str(),
                number(c.baseline_mm, 2).c_str(), c.enrolments);
  return line + c.note;
}

}  // namespace relievo::firmware
