// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>

#include "pipeline/calibrate/quality/quality_measures.h"

namespace relievo::pipeline {
namespace {

// Error across the epipolar line: below 0.1 px excellent, above 0.25 px poor by the scale of ROS
// camera_calibration; beyond 0.7 px matching along rows fails.
constexpr double kGoodEpipolarPx = 0.15;
constexpr double kWorstEpipolarPx = 0.7;
constexpr double kGoodShapeMm = 0.3;
constexpr double kWorstShapeMm = 3.0;
constexpr double kGoodCoverage = 0.45;
constexpr int kGoodViews = 10;

class Verdict {
 public:
  explicit Verdict(CalibrationQuality& quality) : quality_(quality) {
    quality.verdict = CalibrationVerdict::Pass;
  }

  template <typename... Numbers>
  void say(CalibrationVerdict at_best, const char* format, Numbers... numbers) {
    char text[400];
    std::snprintf(text, sizeof text, format, numbers...);
    quality_.reasons.emplace_back(text);
    quality_.verdict = std::max(quality_.verdict, at_best);
  }

 private:
  CalibrationQuality& quality_;
};

const char* name(const CalibrationQuality& q, int view) {
  return q.views[static_cast<std::size_t>(view)].name.c_str();
}

void judge_rig(const CalibrationQuality& q, Verdict& v) {
  if (!q.holds_still)
    v.say(CalibrationVerdict::Usable,
          "left and right do not hold still relative to each other: they disagree %.1f times more than the "
          "corners' noise "
          "explains; fasten the cameras and expose both at the same instant",
          q.slip_ratio);
  if (q.moved_after >= 0)
    v.say(CalibrationVerdict::Usable,
          "a camera seems to have moved after view %s (somewhere from %s to %s): most later pairs disagree "
          "with the earlier ones; "
          "this holds for the pairs used, calibrate again to know the rig of today",
          name(q, q.moved_after), name(q, q.moved_after_first), name(q, q.moved_after_last));
}

}  // namespace

void judge_quality(CalibrationQuality& q) {
  Verdict v(q);
  using enum CalibrationVerdict;
  if (q.held_out_epipolar_px > kWorstEpipolarPx)
    v.say(
        Refuse,
        "views not used for the fit miss their epipolar lines by %.2f px (%.2f is the most that can be used)",
        q.held_out_epipolar_px, kWorstEpipolarPx);
  if (q.shape_sigma_mm > kWorstShapeMm)
    v.say(Refuse,
          "the shape of a head at %.0f mm is uncertain by %.2f mm (%.1f is the most); tilt the board more, "
          "and take more views",
          q.working_distance_mm, q.shape_sigma_mm, kWorstShapeMm);
  judge_rig(q, v);
  const auto pairs = std::count_if(q.views.begin(), q.views.end(),
                                   [](const ViewQuality& view) { return view.distance_mm > 0; });
  if (2 * q.used <= pairs)
    v.say(Refuse, "only %d of %d pairs agree with each other", q.used, static_cast<int>(pairs));
  else if (4 * q.used < 3 * pairs)
    v.say(Usable, "only %d of %d pairs agree with each other", q.used, static_cast<int>(pairs));
  if (q.held_out_epipolar_px > kGoodEpipolarPx && q.held_out_epipolar_px <= kWorstEpipolarPx)
    v.say(Usable, "views not used for the fit miss their epipolar lines by %.2f px (%.2f is good)",
          q.held_out_epipolar_px, kGoodEpipolarPx);
  if (q.shape_sigma_mm > kGoodShapeMm && q.shape_sigma_mm <= kWorstShapeMm)
    v.say(Usable, "the shape of a head at %.0f mm is uncertain by %.2f mm (%.1f is good)",
          q.working_distance_mm, q.shape_sigma_mm, kGoodShapeMm);
  if (q.used < kGoodViews) v.say(Usable, "%d pairs are few; take %d or more", q.used, kGoodViews);
  const double coverage = std::min(q.coverage_left, q.coverage_right);
  if (coverage < kGoodCoverage)
    v.say(Usable, "the boards cover %.0f %% of the picture; bring them to the edges, too", 100 * coverage);
  if (q.reasons.empty())
    v.say(Pass,
          "all figures are good: epipolar error %.2f px on views not used, a head's shape uncertain by %.2f "
          "mm at %.0f mm",
          q.held_out_epipolar_px, q.shape_sigma_mm, q.working_distance_mm);
}

}  // namespace relievo::pipeline
