// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

constexpr double kFaceWidthMm = 150;

std::string tile(std::string_view what, std::string_view sign, double value, std::string_view unit,
                 std::string_view explained) {
  return "<div><h3>" + std::string(what) + "</h3><p class=\"large\">" + std::string(sign) +
         figure(value, decimals_of(value)) + "&nbsp;<i>" + std::string(unit) + "</i></p><p>" +
         std::string(explained) + "</p></div>\n";
}

}  // namespace

std::string face_figures(const CalibrationReport& r) {
  const CalibrationQuality& q = r.output.quality;
  std::string out = "<section class=\"face\">\n<h2>How wrong it may be at a face, " + figure(kFaceMm, 0) +
                    " mm away</h2>\n<div class=\"tiles\">\n";
  out += tile("Depth", "±", kTwoSided95 * q.face_depth_sigma_mm, "mm",
              "holds in 95 of 100 cases, predicted from the pictures of the board");
  out += tile("Width of a face", "±", kTwoSided95 * q.uncertainty.scale_percent / 100 * kFaceWidthMm, "mm",
              "over " + figure(kFaceWidthMm, 0) + " mm, 95 of 100 cases");
  out += tile("Depth, measured", "", q.measured_depth_mm, "mm",
              "boards left out in turn, against the known size of their squares");
  out += tile("Epipolar error", "", q.held_out_epipolar_px, "px",
              "in pairs left out in turn: what matching along rows meets");
  out += tile("Reprojection", "", q.pair_rms_px, "px", "how far corners lie from where the fit puts them");
  return out + "</div>\n</section>\n";
}

}  // namespace relievo::pipeline::report
