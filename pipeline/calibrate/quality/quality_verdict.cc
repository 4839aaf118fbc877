// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

#include "hal/base/words.h"
#include "pipeline/calibrate/quality/quality.h"
#include "pipeline/calibrate/quality/quality_measures.h"

namespace relievo::pipeline {
namespace {

void say(CalibrationQuality& q, CalibrationVerdict at_best, std::string_view pattern,
         std::initializer_list<std::string_view> values) {
  q.reasons.push_back(filled(pattern, values));
  q.verdict = std::max(q.verdict, at_best);
}

std::string_view name(const CalibrationQuality& q, int view) { return q.views[std::size_t(view)].name; }

void judge_board(CalibrationQuality& q) {
  if (q.board_bent)
    say(q, q.board_sag_mm > limits::kWorstSagMm ? CalibrationVerdict::Refuse : CalibrationVerdict::Usable,
        "the board is bent by {} mm (+-{}); glue the print to glass or to a stiff plate",
        {decimal(q.board_sag_mm, 2), decimal(q.board_sag_sigma_mm, 2)});
  const double off = 100 * (q.baseline_mm / q.expected_baseline_mm - 1);
  if (q.expected_baseline_mm > 0 && std::abs(off) > limits::kBaselinePercent)
    say(q, CalibrationVerdict::Refuse,
        "the cameras come out {} mm apart, {} % from the {} mm they are known to be; measure a square of "
        "the board again: it would have to be {} of what was said (if the cameras were mounted anew, "
        "say so: on the screen's page of calibration, or relievo calibrate --baseline-mm 0)",
        {decimal(q.baseline_mm, 2), decimal(off, 1, true), decimal(q.expected_baseline_mm, 2),
         decimal(q.expected_baseline_mm / q.baseline_mm, 3)});
  const double noisy = std::max(q.left_rms_px, q.right_rms_px);
  if (noisy > limits::kBlurredPx)
    say(q, noisy > limits::kUselessPx ? CalibrationVerdict::Refuse : CalibrationVerdict::Usable,
        "the corners are uncertain by {} px ({} is usual): hold the board still, in focus and in good light",
        {decimal(noisy, 2), decimal(limits::kUsualPx, 2)});
}

void judge_depth(CalibrationQuality& q) {
  const auto judge = [&q](double mm, std::string_view worst_words, std::string_view good_words) {
    if (!(mm <= limits::kWorstDepthMm))
      say(q, CalibrationVerdict::Refuse, worst_words,
          {decimal(kFaceMm, 0), decimal(mm, 2), decimal(limits::kWorstDepthMm, 1)});
    else if (mm > limits::kGoodDepthMm)
      say(q, CalibrationVerdict::Usable, good_words,
          {decimal(kFaceMm, 0), decimal(mm, 2), decimal(limits::kGoodDepthMm, 1)});
  };
  judge(q.face_depth_sigma_mm, "depth at {} mm is uncertain by {} mm ({} is the most that can be used)",
        "depth at {} mm is uncertain by {} mm ({} is good)");
  judge(q.measured_depth_mm,
        "brought to {} mm, boards not used for the fit are found {} mm from where the known size of their "
        "squares puts them ({} is the most that can be used)",
        "brought to {} mm, boards not used for the fit are found {} mm from where the known size of their "
        "squares puts them ({} is good)");
}

void judge_variety(CalibrationQuality& q) {
  if (q.tilt_spread_deg < limits::kAlikeDeg)
    say(q, CalibrationVerdict::Refuse,
        "the boards are all held alike: two of them differ by {} degrees as a rule ({} is good); tilt "
        "the board to all sides by 30 degrees",
        {decimal(q.tilt_spread_deg, 0), decimal(limits::kGoodTiltDeg, 0)});
  else if (q.tilt_spread_deg < limits::kGoodTiltDeg)
    say(q, CalibrationVerdict::Usable,
        "two boards differ by {} degrees of tilt as a rule ({} is good); tilt the board more",
        {decimal(q.tilt_spread_deg, 0), decimal(limits::kGoodTiltDeg, 0)});
  if (q.used < limits::kGoodViews)
    say(q, CalibrationVerdict::Usable, "{} pairs are few; take {} or more",
        {std::to_string(q.used), std::to_string(limits::kGoodViews)});
  const double coverage = std::min(q.coverage_left, q.coverage_right);
  if (coverage < limits::kGoodCoverage)
    say(q, CalibrationVerdict::Usable, "the boards cover {} % of the picture; bring them to the edges, too",
        {decimal(100 * coverage, 0)});
}

}  // namespace

const char* name_of(CalibrationVerdict verdict) {
  constexpr std::array kNames{"pass", "usable", "refuse"};
  return kNames[std::size_t(verdict)];
}

void judge_quality(CalibrationQuality& q) {
  q.verdict = CalibrationVerdict::Pass;
  using enum CalibrationVerdict;
  // Written so that not-a-number is refused.
  if (!(q.held_out_epipolar_px <= limits::kWorstEpipolarPx))
    say(q, Refuse,
        "views not used for the fit miss their epipolar lines by {} px ({} is the most that can be used)",
        {decimal(q.held_out_epipolar_px, 2), decimal(limits::kWorstEpipolarPx, 2)});
  if (!(q.held_out_shift_px >= 0))
    say(q, Refuse,
        "too few corners are in both pictures of a pair to tell how well left and right agree; let both "
        "cameras see the same part of the board",
        {});
  if (!(q.shape_sigma_mm <= limits::kWorstShapeMm))
    say(q, Refuse,
        "the shape of a head at {} mm is uncertain by {} mm ({} is the most); tilt the board more, and take "
        "more views",
        {decimal(q.working_distance_mm, 0), decimal(q.shape_sigma_mm, 2), decimal(limits::kWorstShapeMm, 1)});
  if (!q.holds_still)
    say(q, Usable,
        "left and right do not hold still relative to each other: they disagree {} times more than the "
        "corners' noise explains, as {}",
        {decimal(q.slip_ratio, 1),
         q.slip_cause == SlipCause::BoardCarried
             ? "a board does that moves on between two exposures; check the trigger, expose both cameras at the "
               "same instant, and hold the board still"
             : "cameras do that turn on their mounts; fasten them, and expose both at the same instant"});
  if (q.moved_after >= 0)
    say(q, Usable,
        "a camera seems to have moved after view {} (somewhere from {} to {}): most later pairs disagree "
        "with the earlier ones; this holds for the pairs used, calibrate again to know the rig of today",
        {name(q, q.moved_after), name(q, q.moved_after_first), name(q, q.moved_after_last)});
  judge_board(q);
  const auto pairs =
      std::ranges::count_if(q.views, [](const ViewQuality& view) { return view.distance_mm > 0; });
  const bool half_at_most = 2 * q.used <= pairs;
  if (half_at_most || 4 * q.used < 3 * pairs)
    say(q, half_at_most ? Refuse : Usable, "only {} of {} pairs agree with each other",
        {std::to_string(q.used), std::to_string(pairs)});
  if (q.held_out_epipolar_px > limits::kGoodEpipolarPx && q.held_out_epipolar_px <= limits::kWorstEpipolarPx)
    say(q, Usable, "views not used for the fit miss their epipolar lines by {} px ({} is good)",
        {decimal(q.held_out_epipolar_px, 2), decimal(limits::kGoodEpipolarPx, 2)});
  if (q.shape_sigma_mm > limits::kGoodShapeMm && q.shape_sigma_mm <= limits::kWorstShapeMm)
    say(q, Usable, "the shape of a head at {} mm is uncertain by {} mm ({} is good)",
        {decimal(q.working_distance_mm, 0), decimal(q.shape_sigma_mm, 2), decimal(limits::kGoodShapeMm, 1)});
  judge_depth(q);
  judge_variety(q);
  if (q.reasons.empty())
    say(q, Pass,
        "all figures are good: reprojection error {} px; epipolar error {} px on views not used; at {} mm "
        "depth is uncertain by {} mm and was found within {} mm of where the known squares put it; lengths "
        "are uncertain by {} %",
        {decimal(q.pair_rms_px, 3), decimal(q.held_out_epipolar_px, 3), decimal(kFaceMm, 0),
         decimal(q.face_depth_sigma_mm, 3), decimal(q.measured_depth_mm, 3),
         decimal(q.uncertainty.scale_percent, 4)});
}

}  // namespace relievo::pipeline
