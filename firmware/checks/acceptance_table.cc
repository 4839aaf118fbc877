// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "firmware/checks/acceptance_report.h"

namespace relievo::firmware {

std::vector<std::string> acceptance_table(const AcceptanceReport& report, const OpticalCheckOptions& options,
                                          const pipeline::CalibrationQuality& calibration) {
  char text[200];
  std::vector<std::string> lines;
  std::snprintf(text, sizeof text, "calibrated on %d of %zu boards, pair rms %.3f px, baseline %.2f mm",
                calibration.used, calibration.views.size(), calibration.pair_rms_px, calibration.baseline_mm);
  lines.emplace_back(text);
  lines.emplace_back("target         points    used    out  form/flat   size    rms (mm; out: discarded)");
  for (const TargetReading& t : report.targets) {
    char size[16] = "";
    if (t.kind == TargetKind::Dumbbell) std::snprintf(size, sizeof size, "%+.3f", t.size_mm);
    std::snprintf(text, sizeof text, "%-13s %7zu %7zu %6zu %8.3f %8s %8.3f", t.name.c_str(), t.measured,
                  t.used, t.discarded, t.range_mm, size, t.rms_mm);
    lines.emplace_back(text);
  }
  for (const SpacingReading& s : report.spacings) {
    std::snprintf(text, sizeof text, "%-13s spacing %+.3f mm", s.name.c_str(), s.error_mm);
    lines.emplace_back(text);
  }
  for (const AcceptanceLine& line : report.lines(limits_at(options.scale))) {
    std::snprintf(text, sizeof text, "%-20s %+.3f mm, limit %.3f mm: %s (%s)", line.measure.c_str(),
                  line.value_mm, line.limit_mm, line.held() ? "pass" : "FAIL", line.where.c_str());
    lines.emplace_back(text);
  }
  return lines;
}

}  // namespace relievo::firmware
