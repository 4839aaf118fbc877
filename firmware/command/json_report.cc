// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include "firmware/command/report.h"
#include "firmware/version.h"

namespace relievo::firmware {
namespace {

double milliseconds_of(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) * 1e-6; }

}  // namespace

std::string report_json(const Report& report) {
  using Json = nlohmann::ordered_json;
  Json stages = Json::array();
  for (const StageRecord& stage : report.stages) {
    stages.push_back({{"name", stage.name}, {"ms", milliseconds_of(stage.took)}, {"in", stage.in}, {"out", stage.out},
                      {"arena_peak_bytes", stage.arena_peak_bytes}});
  }
  Json algorithms = Json::object();
  for (const std::string& setting : report.algorithms) {
    const std::size_t equals = setting.find('=');
    if (equals != std::string::npos) algorithms[setting.substr(0, equals)] = setting.substr(equals + 1);
  }
  const pipeline::ModelQuality& q = report.quality;
  const Json json{{"version", kVersion},
                  {"calibration", report.calibration},
                  {"algorithms", algorithms},
                  {"stages", stages},
                  {"total_ms", milliseconds_of(report.total)},
                  {"peak_rss_bytes", report.peak_rss_bytes},
                  {"quality",
                   {{"median_sigma_mm", q.median_sigma_mm},
                    {"measured_area_mm2", q.measured_area_mm2},
                    {"coverage", q.coverage},
                    {"width_mm", q.width_mm},
                    {"height_mm", q.height_mm},
                    {"nose_relief_mm", q.nose_relief_mm},
                    {"epipolar_residual_px", q.epipolar_residual_px}}}};
  // A path may hold bytes that are no UTF-8: they are replaced, never thrown about.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace relievo::firmware
