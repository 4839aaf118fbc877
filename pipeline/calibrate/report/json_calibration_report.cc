// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <span>

#include "pipeline/calibrate/report/calibration_report.h"

namespace relievo::pipeline {
namespace {

nlohmann::ordered_json uncertainty_json(const CalibrationUncertainty& u) {
  nlohmann::ordered_json depth = nlohmann::ordered_json::array();
  for (const DepthUncertainty& d : u.depth)
    depth.push_back(
        {{"distance_mm", d.distance_mm}, {"sigma_mm", d.sigma_mm}, {"worst_sigma_mm", d.worst_sigma_mm}});
  nlohmann::ordered_json maps = nlohmann::ordered_json::array();
  for (const ProjectionMap& map : u.projection)
    maps.push_back({{"columns", map.columns}, {"rows", map.rows}, {"sigma_px", map.sigma_px}});
  return {{"slips", u.slips},
          {"scale_percent", u.scale_percent},
          {"depth", depth},
          {"projection_left_right", maps}};
}

// Beyond this the file is of no use to anybody.
constexpr std::size_t kMostResiduals = 200'000;

// A ten-thousandth of a pixel is enough. [x, y, dx, dy] for each corner, null where there is none.
nlohmann::ordered_json residuals_json(std::span<const CornerResidual> corners) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const CornerResidual& c : corners) {
    if (seen(c.at)) all.push_back({rounded(c.at.x), rounded(c.at.y), rounded(c.off.x), rounded(c.off.y)});
    else all.push_back(nullptr);
  }
  return all;
}

nlohmann::ordered_json transform_json(const RigidTransform& t) {
  return {{"rotation", t.rotation.m},
          {"translation_mm", {t.translation_mm.x, t.translation_mm.y, t.translation_mm.z}}};
}

nlohmann::ordered_json lens_json(const CameraIntrinsics& c, std::span<const double> sigma) {
  const auto some = [&sigma](std::size_t from, std::size_t count) {
    return std::vector<double>(sigma.begin() + std::ptrdiff_t(from),
                               sigma.begin() + std::ptrdiff_t(from + count));
  };
  return {{"focal_px", {c.focal_px.x, c.focal_px.y}},
          {"focal_sigma_px", some(0, 2)},
          {"centre_px", {c.centre_px.x, c.centre_px.y}},
          {"centre_sigma_px", some(2, 2)},
          {"distortion", c.distortion},
          {"distortion_sigma", some(4, 5)}};
}

nlohmann::ordered_json calibration_json(const CalibratorOutput& out) {
  const ParameterUncertainty& u = out.quality.uncertainty.parameters;
  nlohmann::ordered_json relation = transform_json(out.calibration.right_from_left);
  relation["turn_sigma_deg"] = u.turn_deg;
  relation["translation_sigma_mm"] = u.translation_mm;
  return {{"image_width_px", out.calibration.left.width_px},
          {"image_height_px", out.calibration.left.height_px},
          {"left", lens_json(out.calibration.left, u.lens[0])},
          {"right", lens_json(out.calibration.right, u.lens[1])},
          {"right_from_left", relation}};
}

nlohmann::ordered_json board_json(const BoardPattern& b) {
  nlohmann::ordered_json board = {{"kind", b.kind == BoardKind::Charuco ? "charuco" : "chessboard"},
                                  {"columns", b.columns},
                                  {"rows", b.rows},
                                  {"square_mm", b.square_mm}};
  if (b.kind == BoardKind::Charuco) {
    board["marker_mm"] = b.marker_side_mm();
    board["marker_bits"] = b.marker_bits;
  }
  return board;
}

nlohmann::ordered_json views_json(const CalibratorOutput& out) {
  std::size_t corners = 0;
  for (const FittedView& fitted : out.views) corners += fitted.left.size() + fitted.right.size();
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < out.quality.views.size(); ++i) {
    const ViewQuality& v = out.quality.views[i];
    views.push_back({{"name", v.name},
                     {"used", v.used},
                     {"reason", v.reason},
                     {"left_rms_px", v.left_rms_px},
                     {"right_rms_px", v.right_rms_px},
                     {"epipolar_rms_px", v.epipolar_rms_px},
                     {"excess_px", v.excess_px},
                     {"corners_dropped", v.corners_dropped},
                     {"distance_mm", v.distance_mm},
                     {"tilt_deg", v.tilt_deg}});
    const FittedView& fitted = out.views[i];
    views.back()["left_from_board"] =
        fitted.placed ? transform_json(fitted.left_from_board) : nlohmann::ordered_json();
    if (corners > kMostResiduals) continue;
    views.back()["left_residuals_px"] = residuals_json(fitted.left);
    views.back()["right_residuals_px"] = residuals_json(fitted.right);
  }
  return views;
}

}  // namespace

std::string calibration_report_json(const CalibrationReport& r) {
  constexpr std::array kSlipCauses{"none", "camera turns", "board carried on between the exposures"};
  const CalibrationQuality& q = r.output.quality;
  const auto view_name = [&q](int view) -> nlohmann::ordered_json {
    if (view < 0) return nullptr;
    return q.views[std::size_t(view)].name;
  };
  const nlohmann::ordered_json report = {{"product", r.product},
                                         {"made_at", r.made_at},
                                         {"source", r.source},
                                         {"board", board_json(r.input.pattern)},
                                         {"verdict", name_of(q.verdict)},
                                         {"reasons", q.reasons},
                                         {"views_used", q.used},
                                         {"views_given", q.views.size()},
                                         {"pair_rms_px", q.pair_rms_px},
                                         {"left_rms_px", q.left_rms_px},
                                         {"right_rms_px", q.right_rms_px},
                                         {"epipolar_rms_px", q.epipolar_rms_px},
                                         {"held_out_epipolar_px", q.held_out_epipolar_px},
                                         {"held_out_shift_px", q.held_out_shift_px},
                                         {"coverage_left", q.coverage_left},
                                         {"coverage_right", q.coverage_right},
                                         {"holds_still", q.holds_still},
                                         {"slip_ratio", q.slip_ratio},
                                         {"slip_cause", kSlipCauses[std::size_t(q.slip_cause)]},
                                         {"moved_after", view_name(q.moved_after)},
                                         {"moved_after_first", view_name(q.moved_after_first)},
                                         {"moved_after_last", view_name(q.moved_after_last)},
                                         {"baseline_mm", q.baseline_mm},
                                         {"baseline_sigma_mm", q.uncertainty.parameters.baseline_mm},
                                         {"expected_baseline_mm", q.expected_baseline_mm},
                                         {"expected_as_in_use", q.expected_as_in_use},
                                         {"tilt_spread_deg", q.tilt_spread_deg},
                                         {"board_sag_mm", q.board_sag_mm},
                                         {"board_sag_sigma_mm", q.board_sag_sigma_mm},
                                         {"board_bent", q.board_bent},
                                         {"working_distance_mm", q.working_distance_mm},
                                         {"depth_sigma_mm", q.depth_sigma_mm},
                                         {"face_depth_sigma_mm", q.face_depth_sigma_mm},
                                         {"shape_sigma_mm", q.shape_sigma_mm},
                                         {"measured_depth_mm", q.measured_depth_mm},
                                         {"measured_point_depth_mm", q.measured_point_depth_mm},
                                         {"measured_length_percent", q.measured_length_percent},
                                         {"uncertainty", uncertainty_json(q.uncertainty)},
                                         {"calibration", calibration_json(r.output)},
                                         {"views", views_json(r.output)}};
  // File names need not be UTF-8.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace relievo::pipeline
