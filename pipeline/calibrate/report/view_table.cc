// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline::report {
namespace {

// As fit/view_selection.h and calibrator.cc do it.
constexpr std::string_view kRule =
    "The rule: a single corner more than 6 standard deviations off its board is dropped, and a board with "
    "more than 15 % of such "
    "corners goes whole. The half of the pairs that agree best on where the cameras stand to each other "
    "(least trimmed squares) "
    "sets the measure; every other pair is let in, cheapest first, as long as its disagreement is no "
    "surprise by an F test at 4 "
    "standard deviations.";

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

}  // namespace

std::string view_table(const CalibrationReport& r) {
  const CalibrationQuality& q = r.output.quality;
  const int out = static_cast<int>(q.views.size()) - q.used;
  std::string html =
      "<section class=\"long\" id=\"views\">\n<h2>The views</h2>\n<p class=\"lead\">" +
      counted(q.used, "pair was", "pairs were") + " used, " +
      (out == 0 ? "none was left out" : counted(out, "was", "were") + " left out") + ". " +
      std::string(kRule) +
      "</p>\n<p class=\"lead\">Left and right: reprojection error with both cameras held together; epipolar: "
      "distance from the "
      "epipolar lines; root mean squares over a view.</p>\n<table class=\"views\">\n<thead><tr>"
      "<th scope=\"col\">View</th><th scope=\"col\">Left and right</th><th scope=\"col\">State</th>";
  for (const char* head : {"Left<small>px</small>", "Right<small>px</small>", "Epipolar<small>px</small>",
                           "Distance<small>mm</small>", "Tilt<small>°</small>"})
    html += "<th scope=\"col\" class=\"value\">" + std::string(head) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t v = 0; v < q.views.size(); ++v) html += row(r, v);
  return html + "</tbody>\n</table>\n</section>\n";
}

}  // namespace relievo::pipeline::report
