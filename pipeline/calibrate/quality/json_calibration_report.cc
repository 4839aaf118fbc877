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
                     {"distance_mm", v.distance_mm}});
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
                                         {"coverage_left", q.coverage_left},
                                         {"coverage_right", q.coverage_right},
                                         {"holds_still", q.holds_still},
                                         {"slip_ratio", q.slip_ratio},
                                         {"moved_after", name_of(q.moved_after)},
                                         {"moved_after_first", name_of(q.moved_after_first)},
                                         {"moved_after_last", name_of(q.moved_after_last)},
                                         {"baseline_mm", q.baseline_mm},
                                         {"working_distance_mm", q.working_distance_mm},
                                         {"depth_sigma_mm", q.depth_sigma_mm},
                                         {"shape_sigma_mm", q.shape_sigma_mm},
                                         {"views", views}};
  // File names need not be UTF-8.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace relievo::pipeline
