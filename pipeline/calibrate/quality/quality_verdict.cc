// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pipeline/calibrate/quality/limits.h"
#include "pipeline/calibrate/quality/quality_measures.h"

namespace relievo::pipeline {
namespace {

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
    v.say(q.board_sag_mm > limits::kWorstSagMm ? CalibrationVerdict::Refuse : CalibrationVerdict::Usable,
          "the board is bent by %.2f mm (+-%.2f); glue the print to glass or to a stiff plate", q.board_sag_mm,
          q.board_sag_sigma_mm);
  const double off = 100 * (q.baseline_mm / q.expected_baseline_mm - 1);
  if (q.expected_baseline_mm > 0 && std::abs(off) > limits::kBaselinePercent)
    v.say(CalibrationVerdict::Refuse,
          "the cameras come out %.2f mm apart, %+.1f %% from the %.2f mm they are known to be; measure a square of the "
          "board again: it would have to be %.3f of what was said",
          q.baseline_mm, off, q.expected_baseline_mm, q.expected_baseline_mm / q.baseline_mm);
  const double noisy = std::max(q.left_rms_px, q.right_rms_px);
  if (noisy > limits::kBlurredPx)
    v.say(noisy > limits::kUselessPx ? CalibrationVerdict::Refuse : CalibrationVerdict::Usable,
          "the corners are uncertain by %.2f px (%.2f is usual): hold the board still, in focus and in good light", noisy,
          limits::kUsualPx);
}

void judge_depth(const CalibrationQuality& q, Verdict& v) {
  const auto judge = [&v](double mm, const char* worst_words, const char* good_words) {
    if (mm > limits::kWorstDepthMm) v.say(CalibrationVerdict::Refuse, worst_words, kFaceMm, mm, limits::kWorstDepthMm);
    else if (mm > limits::kGoodDepthMm) v.say(CalibrationVerdict::Usable, good_words, kFaceMm, mm, limits::kGoodDepthMm);
  };
  judge(q.face_depth_sigma_mm, "depth at %.0f mm is uncertain by %.2f mm (%.1f is the most that can be used)",
        "depth at %.0f mm is uncertain by %.2f mm (%.1f is good)");
  judge(q.measured_depth_mm,
        "brought to %.0f mm, boards not used for the fit are found %.2f mm from where the known size of their squares puts "
        "them (%.1f is the most that can be used)",
        "brought to %.0f mm, boards not used for the fit are found %.2f mm from where the known size of their squares puts "
        "them (%.1f is good)");
}

void judge_variety(const CalibrationQuality& q, Verdict& v) {
  if (q.tilt_spread_deg < limits::kAlikeDeg)
    v.say(CalibrationVerdict::Refuse,
          "the boards are all held alike: two of them differ by %.0f degrees as a rule (%.0f is good); tilt it to all "
          "sides by 30 degrees",
          q.tilt_spread_deg, limits::kGoodTiltDeg);
  else if (q.tilt_spread_deg < limits::kGoodTiltDeg)
    v.say(CalibrationVerdict::Usable, "two boards differ by %.0f degrees of tilt as a rule (%.0f is good); tilt it more",
          q.tilt_spread_deg, limits::kGoodTiltDeg);
  if (q.used < limits::kGoodViews)
    v.say(CalibrationVerdict::Usable, "%d pairs are few; take %d or more", q.used, limits::kGoodViews);
  const double coverage = std::min(q.coverage_left, q.coverage_right);
  if (coverage < limits::kGoodCoverage)
    v.say(CalibrationVerdict::Usable, "the boards cover %.0f %% of the picture; bring them to the edges, too",
          100 * coverage);
}

}  // namespace

void judge_quality(CalibrationQuality& q) {
  Verdict v(q);
  using enum CalibrationVerdict;
  if (q.held_out_epipolar_px > limits::kWorstEpipolarPx)
    v.say(
        Refuse,
        "views not used for the fit miss their epipolar lines by %.2f px (%.2f is the most that can be used)",
        q.held_out_epipolar_px, limits::kWorstEpipolarPx);
  if (q.shape_sigma_mm > limits::kWorstShapeMm)
    v.say(Refuse,
          "the shape of a head at %.0f mm is uncertain by %.2f mm (%.1f is the most); tilt the board more, "
          "and take more views",
          q.working_distance_mm, q.shape_sigma_mm, limits::kWorstShapeMm);
  judge_slip(q, v);
  judge_move(q, v);
  judge_board(q, v);
  const auto pairs = std::count_if(q.views.begin(), q.views.end(),
                                   [](const ViewQuality& view) { return view.distance_mm > 0; });
  if (2 * q.used <= pairs)
    v.say(Refuse, "only %d of %d pairs agree with each other", q.used, static_cast<int>(pairs));
  else if (4 * q.used < 3 * pairs)
    v.say(Usable, "only %d of %d pairs agree with each other", q.used, static_cast<int>(pairs));
  if (q.held_out_epipolar_px > limits::kGoodEpipolarPx && q.held_out_epipolar_px <= limits::kWorstEpipolarPx)
    v.say(Usable, "views not used for the fit miss their epipolar lines by %.2f px (%.2f is good)",
          q.held_out_epipolar_px, limits::kGoodEpipolarPx);
  if (q.shape_sigma_mm > limits::kGoodShapeMm && q.shape_sigma_mm <= limits::kWorstShapeMm)
    v.say(Usable, "the shape of a head at %.0f mm is uncertain by %.2f mm (%.1f is good)",
          q.working_distance_mm, q.shape_sigma_mm, limits::kGoodShapeMm);
  judge_depth(q, v);
  judge_variety(q, v);
  if (q.reasons.empty())
    v.say(Pass,
          "all figures are good: reprojection error %.3f px; epipolar error %.3f px on views not used; at %.0f mm depth is "
          "uncertain by %.3f mm and was found within %.3f mm of where the known squares put it; lengths are uncertain by "
          "%.4f %%",
          q.pair_rms_px, q.held_out_epipolar_px, kFaceMm, q.face_depth_sigma_mm, q.measured_depth_mm,
          q.uncertainty.scale_percent);
}

}  // namespace relievo::pipeline
