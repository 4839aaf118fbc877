// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
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
constexpr double kGoodTiltDeg = 15;
constexpr double kAlikeDeg = 5;
constexpr double kWorstSagMm = 2;
// Nobody knows a baseline to better than half a per cent without having calibrated it.
constexpr double kBaselinePercent = 1.0;
constexpr double kUsualPx = 0.15;
constexpr double kBlurredPx = 0.4;
constexpr double kUselessPx = 1.5;

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

void judge_slip(const CalibrationQuality& q, Verdict& v) {
  if (q.holds_still) return;
  if (q.slip_cause == SlipCause::BoardCarried)
    v.say(CalibrationVerdict::Usable,
          "left and right do not hold still relative to each other: they disagree %.1f times more than the corners' "
          "noise explains, as a board does that moves on between two exposures; check the trigger, expose both cameras "
          "at the same instant, and hold the board still",
          q.slip_ratio);
  else
    v.say(CalibrationVerdict::Usable,
          "left and right do not hold still relative to each other: they disagree %.1f times more than the corners' "
          "noise explains, as cameras do that turn on their mounts; fasten them, and expose both at the same instant",
          q.slip_ratio);
}

void judge_move(const CalibrationQuality& q, Verdict& v) {
  if (q.moved_after < 0) return;
  v.say(CalibrationVerdict::Usable,
        "a camera seems to have moved after view %s (somewhere from %s to %s): most later pairs disagree with the "
        "earlier ones; this holds for the pairs used, calibrate again to know the rig of today",
        name(q, q.moved_after), name(q, q.moved_after_first), name(q, q.moved_after_last));
}

void judge_board(const CalibrationQuality& q, Verdict& v) {
  if (q.board_bent)
    v.say(q.board_sag_mm > kWorstSagMm ? CalibrationVerdict::Refuse : CalibrationVerdict::Usable,
          "the board is bent by %.2f mm (+-%.2f); glue the print to glass or to a stiff plate", q.board_sag_mm,
          q.board_sag_sigma_mm);
  const double off = 100 * (q.baseline_mm / q.expected_baseline_mm - 1);
  if (q.expected_baseline_mm > 0 && std::abs(off) > kBaselinePercent)
    v.say(CalibrationVerdict::Refuse,
          "the cameras come out %.2f mm apart, %+.1f %% from the %.2f mm they are known to be; measure a square of the "
          "board again: it would have to be %.3f of what was said",
          q.baseline_mm, off, q.expected_baseline_mm, q.expected_baseline_mm / q.baseline_mm);
  const double noisy = std::max(q.left_rms_px, q.right_rms_px);
  if (noisy > kBlurredPx)
    v.say(noisy > kUselessPx ? CalibrationVerdict::Refuse : CalibrationVerdict::Usable,
          "the corners are uncertain by %.2f px (%.2f is usual): hold the board still, in focus and in good light", noisy,
          kUsualPx);
}

void judge_variety(const CalibrationQuality& q, Verdict& v) {
  if (q.tilt_spread_deg < kAlikeDeg)
    v.say(CalibrationVerdict::Refuse,
          "the boards are all held alike: two of them differ by %.0f degrees as a rule (%.0f is good); tilt it to all "
          "sides by 30 degrees",
          q.tilt_spread_deg, kGoodTiltDeg);
  else if (q.tilt_spread_deg < kGoodTiltDeg)
    v.say(CalibrationVerdict::Usable, "two boards differ by %.0f degrees of tilt as a rule (%.0f is good); tilt it more",
          q.tilt_spread_deg, kGoodTiltDeg);
  if (q.used < kGoodViews)
    v.say(CalibrationVerdict::Usable, "%d pairs are few; take %d or more", q.used, kGoodViews);
  const double coverage = std::min(q.coverage_left, q.coverage_right);
  if (coverage < kGoodCoverage)
    v.say(CalibrationVerdict::Usable, "the boards cover %.0f %% of the picture; bring them to the edges, too",
          100 * coverage);
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
  judge_slip(q, v);
  judge_move(q, v);
  judge_board(q, v);
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
  judge_variety(q, v);
  if (q.reasons.empty())
    v.say(Pass,
          "all figures are good: epipolar error %.3f px on views not used; at 560 mm depth is uncertain by %.3f mm, "
          "lengths by %.3f %%",
          q.held_out_epipolar_px, q.face_depth_sigma_mm, q.uncertainty.scale_percent);
}

}  // namespace relievo::pipeline
