// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/calibrate/quality/quality.h"
#include "pipeline/calibrate/report/calibration_report.h"
#include "pipeline/calibrate/report/sections.h"
#include "pipeline/report/page.h"

namespace relievo::pipeline {
namespace report {
namespace {

struct Words {
  std::string_view word;
  std::string_view means;
  std::string_view icon;  // told apart by outline, too: disc, triangle, octagon
};

// In the order of CalibrationVerdict.
constexpr Words kVerdicts[] = {
    {"Pass", "Fit for measuring faces.",
     "<circle cx=\"24\" cy=\"24\" r=\"21\"/><path d=\"M14 25l7 7 14-16\"/>"},
    {"Usable", "It measures, less well than it could.",
     "<path class=\"body\" d=\"M24 4L46 43H2Z\"/><path d=\"M24 17v13M24 36.5v.5\"/>"},
    {"Refuse", "Not to be measured with.",
     "<path class=\"body\" d=\"M15 3h18l12 12v18L33 45H15L3 33V15Z\"/><path d=\"M16 16l16 16M32 16L16 32\"/>"}};
static_assert(std::size(kVerdicts) == std::size_t(CalibrationVerdict::Refuse) + 1);

// Empty where all were used.
std::string left_out(const CalibrationQuality& q) {
  constexpr int kMostNames = 30;
  std::string names;
  int count = 0;
  for (const ViewQuality& view : q.views) {
    if (view.used) continue;
    if (++count <= kMostNames) names += (names.empty() ? "<bdi>" : ", <bdi>") + escaped(view.name) + "</bdi>";
  }
  if (count == 0) return {};
  if (count > kMostNames) names += " and " + std::to_string(count - kMostNames) + " more";
  return "<p class=\"omitted\"><b>Left out:</b> " + counted(count, "pair", "pairs") + ": " + names +
         ". Why, and by which rule, is told under <a href=\"#views\">The views</a>.</p>\n";
}

constexpr double kFaceWidthMm = 150;

std::string tile(std::string_view what, std::string_view sign, double value, std::string_view unit,
                 std::string_view explained) {
  return "<div><h3>" + std::string(what) + "</h3><p class=\"large\">" + std::string(sign) +
         figure(value, decimals_of(value)) + "&nbsp;<i>" + std::string(unit) + "</i></p><p>" +
         std::string(explained) + "</p></div>\n";
}

enum class Grade { Good, Fair, Bad, Open };

Grade low_is_good(double value, double good, double worst) {
  if (!(value <= worst)) return Grade::Bad;
  return value <= good ? Grade::Good : Grade::Fair;
}
Grade high_is_good(double value, double good, double worst) {
  if (!(value >= worst)) return Grade::Bad;
  return value >= good ? Grade::Good : Grade::Fair;
}

// In the order of Grade.
constexpr std::string_view kMarks[] = {"<span class=\"mark good\"><b aria-hidden=\"true\">✓</b> good</span>",
                                       "<span class=\"mark fair\"><b aria-hidden=\"true\">!</b> fair</span>",
                                       "<span class=\"mark bad\"><b aria-hidden=\"true\">×</b> bad</span>",
                                       "<span class=\"mark open\">not judged</span>"};
static_assert(std::size(kMarks) == std::size_t(Grade::Open) + 1);

class Table {
 public:
  // All of it HTML.
  void row(std::string_view what, std::string_view explained, std::string_view value, std::string_view good,
           Grade grade) {
    rows_ += "<tr><th scope=\"row\">" + std::string(what) + "<small>" + std::string(explained) +
             "</small></th><td class=\"value\">" + std::string(value) + "</td><td class=\"aim\">" +
             std::string(good) + "</td><td>" + std::string(kMarks[std::size_t(grade)]) + "</td></tr>\n";
  }
  std::string html() const {
    return "<table class=\"key\">\n<thead><tr><th scope=\"col\">Figure</th><th scope=\"col\" "
           "class=\"value\">Here</th>"
           "<th scope=\"col\">Good</th><th scope=\"col\">Judged</th></tr></thead>\n<tbody>\n" +
           rows_ + "</tbody>\n</table>\n";
  }

 private:
  std::string rows_;
};

std::string unit(double value, int decimals, std::string_view name) {
  if (name == "°") return figure(value, decimals) + "°";
  return figure(value, decimals) + "&nbsp;<i>" + std::string(name) + "</i>";
}
// In a second line.
std::string and_below(const std::string& value) { return "<br><span class=\"second\">" + value + "</span>"; }
std::string up_to(double value, int decimals, std::string_view name) {
  return "up to " + figure(value, decimals) + " " + std::string(name);
}
std::string or_more(double value, std::string_view name) {
  return figure(value, 0) + std::string(name) + " or more";
}

void fit_rows(const CalibrationQuality& q, Table& t) {
  t.row("Pairs used", "pairs in which left and right agree",
        std::to_string(q.used) + "&nbsp;<i>of " + std::to_string(q.views.size()) + "</i>",
        or_more(limits::kGoodViews, ""), high_is_good(q.used, limits::kGoodViews, 0));
  t.row("Reprojection error", "pairs used, rms: how far corners lie from where the fit puts them",
        unit(q.pair_rms_px, 3, "px"),
        up_to(limits::kBlurredPx, 2, "px") + "; " + figure(limits::kUsualPx, 2) + " is usual",
        low_is_good(q.pair_rms_px, limits::kBlurredPx, limits::kUselessPx));
  t.row("Epipolar error, held out",
        "rms in pairs that had no part in the fit: what matching along rows will meet",
        unit(q.held_out_epipolar_px, 3, "px"), up_to(limits::kGoodEpipolarPx, 2, "px"),
        low_is_good(q.held_out_epipolar_px, limits::kGoodEpipolarPx, limits::kWorstEpipolarPx));
  t.row("Firmness of the rig", "how far left and right disagree, times what the corners’ noise explains",
        unit(q.slip_ratio, 1, "times"), "below 2 times", q.holds_still ? Grade::Good : Grade::Fair);
}

void trust_rows(const CalibrationQuality& q, Table& t) {
  const double depth = q.face_depth_sigma_mm;
  const int decimals = decimals_of(depth);
  t.row("Depth at " + figure(kFaceMm, 0) + " mm",
        "uncertainty owed to the calibration: one sigma, and 95&nbsp;%",
        unit(depth, decimals, "mm") + and_below("±" + unit(kTwoSided95 * depth, decimals, "mm")),
        up_to(limits::kGoodDepthMm, 1, "mm"),
        low_is_good(depth, limits::kGoodDepthMm, limits::kWorstDepthMm));
  t.row("Depth against the known squares",
        "measured at boards left out of the fit in turn, brought to " + figure(kFaceMm, 0) +
            "&nbsp;mm; below, a single corner with its noise",
        unit(q.measured_depth_mm, decimals_of(q.measured_depth_mm), "mm") +
            and_below(unit(q.measured_point_depth_mm, decimals_of(q.measured_point_depth_mm), "mm a corner")),
        up_to(limits::kGoodDepthMm, 1, "mm"),
        low_is_good(q.measured_depth_mm, limits::kGoodDepthMm, limits::kWorstDepthMm));
  t.row("Shape of a head at " + figure(q.working_distance_mm, 0) + " mm", "laid over the true one, one sigma",
        unit(q.shape_sigma_mm, decimals_of(q.shape_sigma_mm), "mm"), up_to(limits::kGoodShapeMm, 1, "mm"),
        low_is_good(q.shape_sigma_mm, limits::kGoodShapeMm, limits::kWorstShapeMm));
  const double scale = q.uncertainty.scale_percent;
  t.row("Scale", "of lengths, one sigma", unit(scale, decimals_of(scale), "%"),
        up_to(limits::kGoodScalePercent, 1, "%"),
        low_is_good(scale, limits::kGoodScalePercent, limits::kWorstScalePercent));
  const double sigma = q.uncertainty.parameters.baseline_mm;
  const bool expected = q.expected_baseline_mm > 0;
  const double off = 100 * std::abs(q.baseline_mm / q.expected_baseline_mm - 1);
  t.row(
      "Baseline", expected ? "distance of the cameras" : "distance of the cameras; compare it with a ruler",
      unit(q.baseline_mm, decimals_of(sigma), "mm") + and_below("±" + unit(sigma, decimals_of(sigma), "mm")),
      expected ? figure(q.expected_baseline_mm, 2) + " mm within " + figure(limits::kBaselinePercent, 0) +
                     " %" + (q.expected_as_in_use ? ", as in use until now" : ", as it was given")
               : "no expectation was given",
      !expected                         ? Grade::Open
      : off <= limits::kBaselinePercent ? Grade::Good
                                        : Grade::Bad);
}

void board_rows(const CalibrationReport& r, Table& t) {
  const CalibrationQuality& q = r.output.quality;
  const BoardPattern& board = r.input.pattern;
  const double flat_mm = limits::kFlat * board.square_mm * (std::max(board.columns, board.rows) - 1);
  const int decimals = decimals_of(q.board_sag_sigma_mm);
  t.row("Board flatness", "highest over lowest point, with one sigma",
        unit(q.board_sag_mm, decimals, "mm") + and_below("±" + unit(q.board_sag_sigma_mm, decimals, "mm")),
        up_to(flat_mm, 2, "mm") + ", or no more than chance",
        !q.board_bent                          ? Grade::Good
        : q.board_sag_mm > limits::kWorstSagMm ? Grade::Bad
                                               : Grade::Fair);
  t.row("Spread of tilts", "median angle between two boards", unit(q.tilt_spread_deg, 0, "°"),
        or_more(limits::kGoodTiltDeg, "°"),
        high_is_good(q.tilt_spread_deg, limits::kGoodTiltDeg, limits::kAlikeDeg));
  const double coverage = std::min(q.coverage_left, q.coverage_right);
  t.row("Coverage", "share of the picture that boards reached, left and right",
        figure(100 * q.coverage_left, 0) + " and " + unit(100 * q.coverage_right, 0, "%"),
        or_more(100 * limits::kGoodCoverage, " %"), high_is_good(coverage, limits::kGoodCoverage, 0));
}

std::string verdict_section(const CalibrationReport& r) {
  const CalibrationQuality& q = r.output.quality;
  const Words& words = kVerdicts[std::size_t(q.verdict)];
  std::string out =
      "<section class=\"verdict " + std::string(name_of(q.verdict)) + "\">\n<div class=\"stamp\">";
  out += "<svg viewBox=\"0 0 48 48\" aria-hidden=\"true\">" + std::string(words.icon) + "</svg>";
  out += "<div><h2>" + std::string(words.word) + "</h2><p>" + std::string(words.means) +
         "</p></div></div>\n<ul>\n";
  for (const std::string& reason : q.reasons) out += "<li>" + escaped(sentence(reason)) + "</li>\n";
  return out + "</ul>\n" + left_out(q) + "</section>\n";
}

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

std::string key_figures(const CalibrationReport& r) {
  Table table;
  fit_rows(r.output.quality, table);
  trust_rows(r.output.quality, table);
  board_rows(r, table);
  return "<section>\n<h2>The figures that matter</h2>\n" + table.html() + "</section>\n";
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
  using namespace report;
  const CameraIntrinsics& camera = r.output.calibration.left;
  const std::string top =
      heading(r.product, "Calibration report",
              {escaped(r.made_at), "<bdi>" + escaped(r.source) + "</bdi>",
               counted(int(r.output.quality.views.size()), "pair", "pairs") + " of " +
                   std::to_string(camera.width_px) + " × " + std::to_string(camera.height_px) + " px",
               board_words(r.input.pattern)});
  return page("Calibration report: " + r.source, "",
              top + verdict_section(r) + face_figures(r) + key_figures(r) + std::string(kReading) +
                  "<section>\n<h2>How far it can be trusted</h2>\n" +
                  side_by_side(depth_chart(r), rig_plan(r)) + "</section>\n" + projection_maps(r) +
                  coverage_figure(r) + residual_arrows(r) + view_table(r) + number_tables(r));
}

}  // namespace relievo::pipeline
