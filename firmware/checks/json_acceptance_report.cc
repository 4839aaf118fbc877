// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "firmware/base/version.h"
#include "firmware/checks/optical_check.h"

namespace relievo::firmware {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const TargetReading& t) {
  Json json{{"name", t.name},
            {"points_measured", t.measured},
            {"points_used", t.used},
            {"points_discarded", t.discarded},
            {"rms_mm", t.rms_mm}};
  if (t.kind == TargetKind::Plate) {
    json["flatness_mm"] = t.range_mm;
  } else {
    json["form_mm"] = t.range_mm;
    json["size_mm"] = t.size_mm;
    json["centre_mm"] = {t.centre_mm.x, t.centre_mm.y, t.centre_mm.z};
  }
  return json;
}

}  // namespace

std::string acceptance_json(const AcceptanceReport& report, const OpticalCheckOptions& options,
                            const pipeline::CalibrationQuality& calibration) {
  Json lines = Json::array(), targets = Json::array(), spacings = Json::array();
  bool held = true;
  for (const AcceptanceLine& line : report.lines(limits_at(options.scale))) {
    lines.push_back({{"measure", line.measure},
                     {"worst_mm", line.value_mm},
                     {"limit_mm", line.limit_mm},
                     {"where", line.where},
                     {"held", line.held()}});
    held = held && line.held();
  }
  for (const TargetReading& target : report.targets) targets.push_back(json_of(target));
  for (const SpacingReading& spacing : report.spacings)
    spacings.push_back({{"name", spacing.name}, {"error_mm", spacing.error_mm}});
  const OpticalTargets& t = options.targets;
  const Json json{{"version", kVersion},
                  {"verdict", held ? "pass" : "fail"},
                  {"lines", lines},
                  {"seed", options.seed},
                  {"scale", options.scale},
                  {"certificate",
                   {{"sphere_diameter_mm", t.sphere_diameter_mm},
                    {"sphere_spacing_mm", t.sphere_spacing_mm},
                    {"plate_mm", {t.plate_width_mm, t.plate_height_mm}},
                    {"board", {{"corners", {t.board_columns, t.board_rows}}, {"square_mm", t.square_mm}}}}},
                  {"evaluated",
                   {{"discard_share", kDiscardShare},
                    {"sphere_cap_deg", kCapDeg},
                    {"off_the_rod_mm", kRodMm},
                    {"plate_rim_mm", kRimMm}}},
                  {"calibration",
                   {{"boards_used", calibration.used},
                    {"pair_rms_px", calibration.pair_rms_px},
                    {"baseline_mm", calibration.baseline_mm}}},
                  {"targets", targets},
                  {"spacings", spacings}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace relievo::firmware
