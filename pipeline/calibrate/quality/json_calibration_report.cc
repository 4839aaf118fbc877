// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "pipeline/calibrate/quality/quality.h"

namespace relievo::pipeline {
namespace {

const char* word(CalibrationVerdict verdict) {
  switch (verdict) {
    case CalibrationVerdict::Pass:
      return "pass";
    case CalibrationVerdict::Usable:
      return "usable";
    case CalibrationVerdict::Refuse:
      return "refuse";
  }
  return "refuse";
}

const char* word(SlipCause cause) {
  switch (cause) {
    case SlipCause::None:
      return "none";
    case SlipCause::CameraTurns:
      return "camera turns";
    case SlipCause::BoardCarried:
      return "board carried on between the exposures";
  }
  return "none";
}

nlohmann::ordered_json uncertainty_json(const CalibrationUncertainty& u) {
  nlohmann::ordered_json depth = nlohmann::ordered_json::array();
  for (const DepthUncertainty& d : u.depth)
    depth.push_back({{"distance_mm", d.distance_mm}, {"sigma_mm", d.sigma_mm}, {"worst_sigma_mm", d.worst_sigma_mm}});
  nlohmann::ordered_json maps = nlohmann::ordered_json::array();
  for (const ProjectionMap& map : u.projection)
    maps.push_back({{"columns", map.columns}, {"rows", map.rows}, {"sigma_px", map.sigma_px}});
  return {{"slips", u.slips}, {"scale_percent", u.scale_percent}, {"depth", depth}, {"projection_left_right", maps}};
}

}  // namespace

std::string calibration_report_json(const CalibrationQuality& q) {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (const ViewQuality& v : q.views)
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
  const auto name_of = [&q](int view) -> nlohmann::ordered_json {
    if (view < 0) return nullptr;
    return q.views[static_cast<std::size_t>(view)].name;
  };
  const nlohmann::ordered_json report = {{"verdict", word(q.verdict)},
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
                                         {"slip_cause", word(q.slip_cause)},
                                         {"moved_after", name_of(q.moved_after)},
                                         {"moved_after_first", name_of(q.moved_after_first)},
                                         {"moved_after_last", name_of(q.moved_after_last)},
                                         {"baseline_mm", q.baseline_mm},
                                         {"expected_baseline_mm", q.expected_baseline_mm},
                                         {"tilt_spread_deg", q.tilt_spread_deg},
                                         {"board_sag_mm", q.board_sag_mm},
                                         {"board_sag_sigma_mm", q.board_sag_sigma_mm},
                                         {"board_bent", q.board_bent},
                                         {"working_distance_mm", q.working_distance_mm},
                                         {"depth_sigma_mm", q.depth_sigma_mm},
                                         {"face_depth_sigma_mm", q.face_depth_sigma_mm},
                                         {"shape_sigma_mm", q.shape_sigma_mm},
                                         {"uncertainty", uncertainty_json(q.uncertainty)},
                                         {"views", views}};
  // File names need not be UTF-8.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace relievo::pipeline
