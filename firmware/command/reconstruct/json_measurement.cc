// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "firmware/command/reconstruct/measurement_report.h"

namespace relievo::firmware {

std::string measurement_json(const measure::Measurement& m, const std::string& report) {
  using Json = nlohmann::ordered_json;
  const Json json{{"accuracy_median_mm", m.accuracy_median_mm},
                  {"accuracy_p95_mm", m.accuracy_p95_mm},
                  {"interior_median_mm", m.interior_median_mm},
                  {"interior_p95_mm", m.interior_p95_mm},
                  {"complete_0.25mm", m.complete_quarter_mm},
                  {"complete_0.5mm", m.complete_half_mm},
                  {"complete_1mm", m.complete_1mm},
                  {"outliers_3mm", m.outliers_3mm},
                  {"measured_vertices_in_face", m.measured_vertices},
                  {"within_sigma", m.within_sigma},
                  {"within_1.96_sigma", m.within_196_sigma},
                  {"moved_mm", m.moved_mm},
                  {"turned_deg", m.turned_deg},
                  {"report", Json::parse(report)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace relievo::firmware
