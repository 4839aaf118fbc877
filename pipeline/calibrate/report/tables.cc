// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/fit/bundle.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/page.h"

namespace relievo::pipeline::report {
namespace {

// As fit/stereo_fit.h and calibrator.cc do it.
constexpr std::string_view kRule =
    "The rule: a single corner more than 6 standard deviations off its board is dropped, and a board with "
    "more than 15 % of such corners goes whole. The half of the pairs that agree best on where the cameras "
    "stand to each other (least trimmed squares) sets the measure; every other pair is let in, cheapest "
    "first, as long as its disagreement is no surprise by an F test at 4 standard deviations.";

constexpr double kThumb = 160;
constexpr double kWideGap = 7;

// What was found in the picture, whether it took part or not.
std::string thumbnail(const CalibrationReport& r, std::size_t v, std::size_t eye) {
  const CameraIntrinsics& camera = camera_of(r, eye);
  const double scale = kThumb / camera.width_px;
  const Size size{kThumb, scale * camera.height_px};
  Drawing d(size, std::string(eye == 0 ? "left" : "right") + " picture with its corners");
  if (v < r.pictures.size()) {
    const auto& jpeg = eye == 0 ? r.pictures[v].left_jpeg : r.pictures[v].right_jpeg;
    if (!jpeg.empty()) d.picture({{0, 0}, size}, jpeg);
  }
  Strokes dots;
  double least_gap = kThumb;  // between neighbours of a row, as drawn
  const BoardView& view = r.input.views[v];
  const BoardCorners& corners = eye == 0 ? view.left : view.right;
  const std::size_t stride = corner_stride(r);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!seen(corners[i])) continue;
    if (i % stride == 0) dots.dot({(corners[i].x + 0.5) * scale, (corners[i].y + 0.5) * scale});
    if (i > 0 && seen(corners[i - 1]))
      least_gap = std::min(
          least_gap, scale * std::hypot(corners[i].x - corners[i - 1].x, corners[i].y - corners[i - 1].y));
  }
  d.strokes(least_gap > kWideGap ? "dots found large" : "dots found", dots);
  d.box("frame", {{0.25, 0.25}, {size.width - 0.5, size.height - 0.5}});
  return d.svg();
}

std::string pictures(const CalibrationReport& r, std::size_t v) {
  std::string out = "<div class=\"thumbs\">" + thumbnail(r, v, 0) + thumbnail(r, v, 1) + "</div>";
  if (v >= r.pictures.size()) return out;
  const ViewPictures& p = r.pictures[v];
  const auto link = [](const std::string& file, std::string_view words) {
    return file.empty() ? std::string() : "<a href=\"" + linked(file) + "\">" + std::string(words) + "</a> ";
  };
  const std::string links = link(p.corners_file, "corners") + link(p.rectified_file, "rectified");
  return links.empty() ? out : out + "<div class=\"links\">" + links + "</div>";
}

std::string cell(std::string_view label, double value, int decimals) {
  return "<td class=\"value\" data-label=\"" + std::string(label) + "\">" +
         (value > 0 ? figure(value, decimals) : "–") + "</td>";
}

std::string state(const ViewQuality& view) {
  std::string out = view.used ? "<span class=\"mark good\"><b aria-hidden=\"true\">✓</b> used</span>"
                              : "<span class=\"mark bad\"><b aria-hidden=\"true\">×</b> left out</span>";
  if (!view.reason.empty()) out += "<p>" + escaped(sentence(view.reason)) + "</p>";
  if (view.corners_dropped > 0)
    out += "<p>" + counted(view.corners_dropped, "stray corner", "stray corners") + " dropped.</p>";
  return out;
}

std::string row(const CalibrationReport& r, std::size_t v) {
  const ViewQuality& view = r.output.quality.views[v];
  return "<tr" + std::string(view.used ? "" : " class=\"out\"") + ">\n<th scope=\"row\"><bdi>" +
         escaped(view.name) + "</bdi></th>\n<td>" + pictures(r, v) + "</td>\n<td class=\"state\">" +
         state(view) + "</td>\n" + cell("left, px", view.left_rms_px, 3) +
         cell("right, px", view.right_rms_px, 3) + cell("epipolar, px", view.epipolar_rms_px, 3) +
         cell("distance, mm", view.distance_mm, 0) + cell("tilt, °", view.tilt_deg, 0) + "\n</tr>\n";
}

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
  const Eigen::Vector3d turn = kDegrees * bundle::turn_of(bundle::pose_of(t).rotation);
  const std::array<double, 3> shift = {t.translation_mm.x, t.translation_mm.y, t.translation_mm.z};
  const char* const axes[] = {"x", "y", "z"};
  std::string out =
      "<table class=\"numbers\">\n<caption>Right camera from left camera</caption>\n<thead><tr>"
      "<th scope=\"col\">Parameter</th><th scope=\"col\" colspan=\"2\">Value</th></tr></thead>\n<tbody>\n";
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

std::string view_table(const CalibrationReport& r) {
  const CalibrationQuality& q = r.output.quality;
  const int out = int(q.views.size()) - q.used;
  std::string html =
      "<section class=\"long\" id=\"views\">\n<h2>The views</h2>\n<p class=\"lead\">" +
      counted(q.used, "pair was", "pairs were") + " used, " +
      (out == 0 ? "none was left out" : counted(out, "was", "were") + " left out") + ". " +
      std::string(kRule) +
      "</p>\n<p class=\"lead\">Left and right: reprojection error with both cameras held together; epipolar: "
      "distance from the epipolar lines; root mean squares over a view.</p>\n<table class=\"views\">\n<thead><tr>"
      "<th scope=\"col\">View</th><th scope=\"col\">Left and right</th><th scope=\"col\">State</th>";
  for (const char* head : {"Left<small>px</small>", "Right<small>px</small>", "Epipolar<small>px</small>",
                           "Distance<small>mm</small>", "Tilt<small>°</small>"})
    html += "<th scope=\"col\" class=\"value\">" + std::string(head) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t v = 0; v < q.views.size(); ++v) html += row(r, v);
  return html + "</tbody>\n</table>\n</section>\n";
}

std::string number_tables(const CalibrationReport& r) {
  return "<section>\n<h2>The numbers</h2>\n<p class=\"lead\">With one sigma. Lens model: pinhole with "
         "Brown–Conrady distortion in OpenCV’s order; pixel (0, 0) is the centre of the top left pixel. "
         "All digits are in report.json.</p>\n"
         "<div class=\"pair tables\">\n<div class=\"scroll\">\n" +
         lens_table(r) + "</div>\n<div class=\"scroll\">\n" + relation_table(r) + matrix_table(r) +
         "</div>\n</div>\n" + set_table(r) + "</section>\n";
}

}  // namespace relievo::pipeline::report
