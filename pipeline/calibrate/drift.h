// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Has the rig moved since it was calibrated? Every capture says: the face's own texture shows how far
// the rows of the two views are from agreeing (EpipolarShift).
//
// A face of an unmoved rig shows a shift field p (offset, tilt across, tilt down) that is normal about
// zero with covariance C + (e^2 + s^2) M^-1: C what the matches scatter by, e what the calibration
// itself promises (epipolar_shift_px), s what skin adds (its highlights move with the viewer and no
// calibration knows of them), M the moments of the face, so that e and s are rms over it. The statistic
// p' (C + (e^2 + s^2) M^-1)^-1 p is then below kDriftStatistic with 99.9 %: directions in which a face
// tells little do not hide one in which it tells much. e counts in full in every direction, though it
// is all of them together: the judgement errs to the calibration's side.
// Proven on simulated heads by tests/bench/calibration/drift_proof.cc.
//
// What cannot be seen: the same error along the rows. It changes the depth of the face, not its
// likeness. So beyond kRefusedPx, where a camera has certainly moved, nothing is measured any more: a
// knock that moved a picture by so much across the rows has moved it as likely by as much along them,
// and one and a half pixels there are a millimetre or two of depth.
// Pixels of the full-size rectified view. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hal/base/result.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/match_set.h"

namespace relievo::pipeline {

// Chi-square with three degrees of freedom, 99.9 %.
inline constexpr double kDriftStatistic = 16.27;
inline constexpr double kSkinShiftPx = 0.02;       // measured on simulated heads with highlights
inline constexpr double kUnknownPromisePx = 0.03;  // of a calibration that does not say
inline constexpr double kRefusedPx = 1.5;
// A face that leaves the shift less certain than this would not show 0.2 px: it says nothing.
inline constexpr double kUselessSigmaPx = 0.1;

enum class DriftVerdict : std::uint8_t { Unknown, Ok, Warn, Refuse };

struct DriftJudgement {
  DriftVerdict verdict = DriftVerdict::Unknown;
  double residual_px = 0;  // rms of the shift over the face
  double sigma_px = 0;     // and of its standard deviation, as far as the face is to blame
  double offset_px = 0;    // these three as EpipolarShift has them: report.json tells them
  double slope_x = 0;
  double slope_y = 0;
  double expected_px = 0;  // what the calibration promises
  double statistic = 0;    // against kDriftStatistic
};

// Unknown where the shift was not measured, or not well enough.
DriftJudgement judge_drift(const EpipolarShift& shift, const StereoCalibration& calibration);

std::string_view word(DriftVerdict verdict);  // unknown, ok, warn, refuse
// For a technician: what was found, and what to do.
std::string sentence(const DriftJudgement& judgement);
// Of a verdict of Refuse: NotCalibrated.
Error error_of(const DriftJudgement& judgement);

}  // namespace relievo::pipeline
