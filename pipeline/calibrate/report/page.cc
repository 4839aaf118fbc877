// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "pipeline/calibrate/report/calibration_report.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/text.h"

namespace relievo::pipeline {
namespace report {
namespace {

std::string heading_of(const CalibrationReport& r) {
  return heading(r.product, "Calibration report",
                 {escaped(r.made_at), "<bdi>" + escaped(r.source) + "</bdi>",
                  counted(int(r.output.quality.views.size()), "pair", "pairs") + " of " +
                      std::to_string(r.output.calibration.left.width_px) + " × " +
                      std::to_string(r.output.calibration.left.height_px) + " px",
                  board_words(r.input.pattern)});
}

constexpr std::string_view kReading =
    "<section class=\"reading\">\n<h2>How to read this</h2>\n<p>The verdict is the worst of its reasons, and "
    "each reason says what to do. One sigma holds in two cases of three, 95 % in nineteen of twenty; all of "
    "it is what the calibration is to blame for, the matching of a face adds its own. Among the pictures look "
    "for three things: a picture the board has not covered, arrows that lie in one direction, and a pair left "
    "out for a reason you do not believe.</p>\n</section>\n";

}  // namespace

std::size_t corner_stride(const CalibrationReport& r) {
  constexpr std::size_t kMostCorners = 20'000;
  std::size_t most = 0;
  for (const std::size_t eye : {0U, 1U}) {
    std::size_t count = 0;
    for (const FittedView& view : r.output.views) count += view.corners(eye).size();
    most = std::max(most, count);
  }
  return 1 + most / kMostCorners;
}

const CameraIntrinsics& camera_of(const CalibrationReport& r, std::size_t eye) {
  return eye == 0 ? r.output.calibration.left : r.output.calibration.right;
}

std::string board_words(const BoardPattern& b) {
  const bool charuco = b.kind == BoardKind::Charuco;
  return std::string(charuco ? "ChArUco" : "chessboard") + ", " + std::to_string(b.columns) + " × " +
         std::to_string(b.rows) + " inner corners, squares of " + number(b.square_mm, 3) + " mm" +
         (charuco ? ", markers of " + number(b.marker_side_mm(), 3) + " mm" : "");
}

}  // namespace report

std::string calibration_report_html(const CalibrationReport& r) {
  std::string out = report::heading_of(r);
  out += report::verdict_section(r);
  out += report::face_figures(r);
  out += report::key_figures(r);
  out += report::kReading;
  out += "<section>\n<h2>How far it can be trusted</h2>\n" +
         report::side_by_side(report::depth_chart(r), report::rig_plan(r)) + "</section>\n";
  out += report::projection_maps(r);
  out += report::coverage_figure(r);
  out += report::residual_arrows(r);
  out += report::view_table(r);
  out += report::number_tables(r);
  return report::page("Calibration report: " + r.source, "", out);
}

}  // namespace relievo::pipeline
