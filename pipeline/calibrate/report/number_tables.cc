// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "pipeline/calibrate/fit/bundle.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

constexpr double kDegrees = 57.29577951308232;

// Two cells: the number with as many decimals as its sigma means, and the sigma.
std::string with_sigma(double value, double sigma) {
  const int decimals = decimals_for(sigma);
  return "<td class=\"value\">" + figure(value, decimals) + "</td><td class=\"sigma\">± " +
         figure(sigma, decimals) + "</td>";
}

std::string head(std::string_view what) { return "<tr><th scope=\"row\">" + std::string(what) + "</th>"; }

std::string lens_table(const CalibrationReport& r) {
  constexpr std::array<std::string_view, 9> kNames = {
      "focal f<sub>x</sub>",      "focal f<sub>y</sub>",      "centre c<sub>x</sub>",
      "centre c<sub>y</sub>",     "radial k<sub>1</sub>",     "radial k<sub>2</sub>",
      "tangential p<sub>1</sub>", "tangential p<sub>2</sub>", "radial k<sub>3</sub>"};
  const ParameterUncertainty& u = r.output.quality.uncertainty.parameters;
  const std::array<bundle::CameraVector, 2> lens = {bundle::parameters_of(camera_of(r, 0)),
                                                    bundle::parameters_of(camera_of(r, 1))};
  std::string out =
      "<table class=\"numbers\">\n<caption>Lenses</caption>\n<thead><tr><th scope=\"col\">Parameter</th>"
      "<th scope=\"col\" colspan=\"2\">Left camera</th><th scope=\"col\" colspan=\"2\">Right "
      "camera</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    out += head(std::string(kNames[i]) + (i < 4 ? ", px" : "")) + with_sigma(lens[0][at], u.lens[0][i]) +
           with_sigma(lens[1][at], u.lens[1][i]) + "</tr>\n";
  }
  return out + "</tbody>\n</table>\n";
}

std::string relation_table(const CalibrationReport& r) {
  const RigidTransform& t = r.output.calibration.right_from_left;
  const ParameterUncertainty& u = r.output.quality.uncertainty.parameters;
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = t.rotation.m[i];
  const Eigen::Vector3d turn = kDegrees * bundle::turn_of(rotation);
  const std::array<double, 3> shift = {t.translation_mm.x, t.translation_mm.y, t.translation_mm.z};
  const char* const axes[] = {"x", "y", "z"};
  std::string out =
      "<table class=\"numbers\">\n<caption>Right camera from left camera</caption>\n<thead><tr><th "
      "scope=\"col\">Parameter</th>"
      "<th scope=\"col\" colspan=\"2\">Value</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < 3; ++i)
    out += head("turn about " + std::string(axes[i]) + ", °") +
           with_sigma(turn[static_cast<Eigen::Index>(i)], u.turn_deg[i]) + "</tr>\n";
  for (std::size_t i = 0; i < 3; ++i)
    out += head("translation " + std::string(axes[i]) + ", mm") + with_sigma(shift[i], u.translation_mm[i]) +
           "</tr>\n";
  out += head("baseline, mm") + with_sigma(r.output.quality.baseline_mm, u.baseline_mm) + "</tr>\n";
  return out + "</tbody>\n</table>\n";
}

std::string matrix_table(const CalibrationReport& r) {
  std::string out =
      "<table class=\"numbers matrix\">\n<caption>Rotation, right from left</caption>\n<tbody>\n";
  for (std::size_t row = 0; row < 3; ++row) {
    out += "<tr>";
    for (std::size_t column = 0; column < 3; ++column)
      out += "<td class=\"value\">" +
             figure(r.output.calibration.right_from_left.rotation.m[3 * row + column], 7) + "</td>";
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n";
}

std::string field_of_view(const CameraIntrinsics& c) {
  const double degrees = kDegrees * (std::atan((c.centre_px.x + 0.5) / c.focal_px.x) +
                                     std::atan((c.width_px - 0.5 - c.centre_px.x) / c.focal_px.x));
  return figure(degrees, 1) + "°";
}

std::string set_table(const CalibrationReport& r) {
  const CalibrationQuality& q = r.output.quality;
  std::string out = "<table class=\"numbers set\">\n<caption>This set</caption>\n<tbody>\n";
  const auto row = [&out](std::string_view what, const std::string& value) {
    out += head(what) + "<td>" + value + "</td></tr>\n";
  };
  row("board", board_words(r.input.pattern));
  row("pictures", std::to_string(r.output.calibration.left.width_px) + " × " +
                      std::to_string(r.output.calibration.left.height_px) + " px");
  row("fields of view", field_of_view(r.output.calibration.left) + " and " +
                            field_of_view(r.output.calibration.right) + " across, without distortion");
  row("each camera alone", figure(q.left_rms_px, 3) + " and " + figure(q.right_rms_px, 3) + " px rms");
  row("from", "<bdi>" + escaped(r.source) + "</bdi>");
  row("calibrated", escaped(r.made_at));
  row("by", escaped(r.product));
  return out + "</tbody>\n</table>\n";
}

}  // namespace

std::string number_tables(const CalibrationReport& r) {
  return "<section>\n<h2>The numbers</h2>\n<p class=\"lead\">With one sigma. Lens model: pinhole with "
         "Brown–Conrady distortion in "
         "OpenCV’s order; pixel (0, 0) is the centre of the top left pixel. All digits are in "
         "report.json.</p>\n"
         "<div class=\"pair tables\">\n<div class=\"scroll\">\n" +
         lens_table(r) + "</div>\n<div class=\"scroll\">\n" + relation_table(r) + matrix_table(r) +
         "</div>\n</div>\n" + set_table(r) + "</section>\n";
}

}  // namespace relievo::pipeline::report
