// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/drift.h"

#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "hal/base/words.h"
#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

double statistic_of(const EpipolarShift& shift, double expected_px) {
  const Eigen::Vector3d field(shift.offset_px, shift.slope_x * shift.spread_x_px,
                              shift.slope_y * shift.spread_y_px);
  const auto& c = shift.covariance_px2;
  Eigen::Matrix3d covariance;
  covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  Eigen::Matrix3d moments = Eigen::Matrix3d::Identity();
  moments(1, 2) = moments(2, 1) = shift.correlation;
  const double unmoved = expected_px * expected_px + kSkinShiftPx * kSkinShiftPx;
  const Eigen::Matrix3d usual = covariance + unmoved * moments.inverse();
  return field.dot(solved<3>(usual, field));
}

}  // namespace

DriftJudgement judge_drift(const EpipolarShift& shift, const StereoCalibration& calibration) {
  DriftJudgement judgement;
  judgement.expected_px =
      calibration.epipolar_shift_px > 0 ? calibration.epipolar_shift_px : kUnknownPromisePx;
  if (!shift.measured()) return judgement;
  judgement.residual_px = shift.residual_px;
  judgement.sigma_px = shift.sigma_px;
  judgement.offset_px = shift.offset_px;
  judgement.slope_x = shift.slope_x;
  judgement.slope_y = shift.slope_y;
  judgement.statistic = statistic_of(shift, judgement.expected_px);
  if (!std::isfinite(judgement.statistic)) return DriftJudgement{.expected_px = judgement.expected_px};
  // What stands out of a vague measurement stands out.
  if (judgement.statistic > kDriftStatistic)
    judgement.verdict = judgement.residual_px > kRefusedPx ? DriftVerdict::Refuse : DriftVerdict::Warn;
  else judgement.verdict = judgement.sigma_px > kUselessSigmaPx ? DriftVerdict::Unknown : DriftVerdict::Ok;
  return judgement;
}

std::string_view word(DriftVerdict verdict) {
  constexpr std::array kWords{"unknown", "ok", "warn", "refuse"};
  return kWords[std::size_t(verdict)];
}

std::string sentence(const DriftJudgement& j) {
  switch (j.verdict) {
    case DriftVerdict::Unknown: break;
    case DriftVerdict::Ok:
      return filled("the rows of both views agree to {} px ({} px promised)",
                    {decimal(j.residual_px, 3), decimal(j.expected_px, 3)});
    case DriftVerdict::Warn:
      return filled(
          "the rows of both views disagree by {} px ({} px promised): a camera has moved, calibrate again",
          {decimal(j.residual_px, 2), decimal(j.expected_px, 3)});
    case DriftVerdict::Refuse:
      return filled(
          "the rows of both views disagree by {} px (more than {} px is refused): a camera has moved, "
          "calibrate again",
          {decimal(j.residual_px, 2), decimal(kRefusedPx, 1)});
  }
  return "this face has too little texture to tell whether the cameras have moved";
}

Error error_of(const DriftJudgement& judgement) {
  return Error{Errc::NotCalibrated, "a camera has moved since it was calibrated: calibrate again"}.at(
      decimal(judgement.residual_px, 2) + " px");
}

}  // namespace relievo::pipeline
