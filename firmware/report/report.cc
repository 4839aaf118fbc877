// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/report/report.h"

#include <cinttypes>
#include <cstdio>

#include <sys/resource.h>

namespace relievo::firmware {

namespace {

constexpr double kWorthSayingPx = 0.1;  // less is within what matching follows, and no advice makes it better
constexpr double kWorthSayingShare = 0.02;  // a shine on the nose is less

}  // namespace

std::string line_of(const StageRecord& stage) {
  char line[128];
  std::snprintf(line, sizeof line, "%-12.*s %8.0f ms %10" PRIu64 " -> %" PRIu64,
                static_cast<int>(stage.name.size()), stage.name.data(),
                static_cast<double>(stage.took.count()) * 1e-6, stage.in, stage.out);
  return line;
}

std::string line_of(std::size_t pair, const PoseReport& pose) {
  char line[160];
  if (!pose.joined) {
    std::snprintf(line, sizeof line,
                  "Pair %-7zu left out: it meets none of the others, or the skin moved by more than 1.5 mm",
                  pair);
    return line;
  }
  std::snprintf(
      line, sizeof line,
      "Pair %-7zu turned by %.1f degrees, %.3f mm rms from the others; placed to %.3f degrees, %.3f mm", pair,
      pose.turned_deg, pose.rms_mm, pose.sigma_deg, pose.sigma_mm);
  return line;
}

std::string line_of(const pipeline::DriftJudgement& drift) {
  return "Calibration  " + std::string(word(drift.verdict)) + ": " + sentence(drift);
}

std::string line_of_motion(double motion_px) {
  if (motion_px < kWorthSayingPx) return {};
  char line[192];
  std::snprintf(
      line, sizeof line,
      "Motion       the face moved between the two exposures, %.2f px rms: what moved is less certain. "
      "Hold still, or expose both cameras together",
      motion_px);
  return line;
}

std::string line_of_light(const pipeline::Overexposure& white) {
  const bool left = white.left >= white.right;
  const double share = left ? white.left : white.right;
  if (share < kWorthSayingShare) return {};
  char line[192];
  std::snprintf(
      line, sizeof line,
      "Light        %.0f %% of the face is white in the %s picture and cannot be measured there: less light, or a shorter exposure",
      100 * share, left ? "left" : "right");
  return line;
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace relievo::firmware
