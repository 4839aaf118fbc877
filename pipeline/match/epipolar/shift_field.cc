// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/shift_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory_resource>
#include <vector>

#include <Eigen/Dense>

#include "hal/base/statistics.h"
#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

constexpr std::size_t kLeastLocals = 12;
constexpr int kLeastBlocks = 8;
constexpr int kReweightings = 8;
constexpr double kTukey = 4.685;  // 95 % efficient where errors are normal
constexpr double kMedianOfAbsolute = 0.6745;
constexpr double kLeastScalePx = 1e-6;  // perfect measurements divide nothing by zero

using Numbers = std::pmr::vector<double>;

// The face's points: middle, spread and correlation, by weight.
void describe_face(std::span<const LocalShift> locals, const Numbers& weight, EpipolarShift& face) {
  double sum = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < locals.size(); ++k) {
    sum += weight[k];
    x += weight[k] * locals[k].x_px;
    y += weight[k] * locals[k].y_px;
  }
  face.middle_x_px = x / sum;
  face.middle_y_px = y / sum;
  for (std::size_t k = 0; k < locals.size(); ++k) {
    const double dx = locals[k].x_px - face.middle_x_px, dy = locals[k].y_px - face.middle_y_px;
    xx += weight[k] * dx * dx;
    yy += weight[k] * dy * dy;
    xy += weight[k] * dx * dy;
  }
  face.spread_x_px = std::max(1.0, std::sqrt(xx / sum));
  face.spread_y_px = std::max(1.0, std::sqrt(yy / sum));
  face.correlation = std::clamp(xy / sum / (face.spread_x_px * face.spread_y_px), -0.99, 0.99);
}

Eigen::Vector3d basis(const EpipolarShift& face, const LocalShift& at, bool slopes) {
  if (!slopes) return {1, 0, 0};
  return {1, (at.x_px - face.middle_x_px) / face.spread_x_px,
          (at.y_px - face.middle_y_px) / face.spread_y_px};
}

Eigen::Matrix3d moments(const EpipolarShift& face) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  m(1, 2) = m(2, 1) = face.correlation;
  return m;
}

struct Fit {
  Eigen::Vector3d field;
  Eigen::Matrix3d
      slope;  // of the equations that the field solves: what an error of a measurement moves it by
};

Fit reweighted(std::span<const LocalShift> locals, bool slopes, const EpipolarShift& face,
               const Numbers& prior, Numbers& weight, Numbers& room) {
  // The median starts it: least squares could be pulled out of the reach of the biweight.
  for (std::size_t k = 0; k < locals.size(); ++k) room[k] = locals[k].shift_px;
  Fit fit{{median(room), 0, 0}, {}};
  const Eigen::Matrix3d unused =
      slopes ? Eigen::Matrix3d::Zero() : Eigen::Matrix3d(Eigen::Vector3d(0, 1, 1).asDiagonal());
  for (int round = 0; round < kReweightings; ++round) {
    const auto off = [&](std::size_t k) {
      return (locals[k].shift_px - fit.field.dot(basis(face, locals[k], slopes))) * std::sqrt(prior[k]);
    };
    for (std::size_t k = 0; k < locals.size(); ++k) room[k] = std::abs(off(k));
    const double limit = kTukey * std::max(median(room) / kMedianOfAbsolute, kLeastScalePx);
    Eigen::Matrix3d information = fit.slope = unused;
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < locals.size(); ++k) {
      const double u = off(k) / limit;
      const double inside = std::max(0.0, 1 - u * u);
      weight[k] = prior[k] * inside * inside;
      const Eigen::Vector3d b = basis(face, locals[k], slopes);
      information += weight[k] * b * b.transpose();
      fit.slope += prior[k] * inside * (1 - 5 * u * u) * b * b.transpose();
      right += weight[k] * locals[k].shift_px * b;
    }
    fit.field = solved<3>(information, right);
  }
  return fit;
}

// False where too few blocks speak.
bool sandwich(std::span<const LocalShift> locals, bool slopes, const EpipolarShift& face, const Fit& fit,
              const Numbers& weight, Eigen::Matrix3d& covariance) {
  std::array<Eigen::Vector3d, kShiftBlocks> scores;
  scores.fill(Eigen::Vector3d::Zero());
  std::array<bool, kShiftBlocks> spoke{};
  for (std::size_t k = 0; k < locals.size(); ++k) {
    const Eigen::Vector3d b = basis(face, locals[k], slopes);
    const auto block = static_cast<std::size_t>(locals[k].block);
    scores[block] += weight[k] * (locals[k].shift_px - fit.field.dot(b)) * b;
    spoke[block] = spoke[block] || weight[k] > 0;
  }
  const auto blocks = std::count(spoke.begin(), spoke.end(), true);
  if (blocks < kLeastBlocks) return false;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& score : scores) scatter += score * score.transpose();
  const Eigen::Matrix3d inverse = fit.slope.inverse();
  covariance = static_cast<double>(blocks) / static_cast<double>(blocks - 3) * inverse * scatter * inverse;
  return covariance.allFinite() && fit.field.allFinite();
}

}  // namespace

EpipolarShift fit_shift_field(std::span<const LocalShift> locals, bool slopes, Arena& scratch) {
  if (locals.size() < kLeastLocals) return {};
  Arena::Mark mark(scratch);
  Numbers prior(locals.size(), &scratch), weight(locals.size(), &scratch), room(locals.size(), &scratch);
  for (std::size_t k = 0; k < locals.size(); ++k) room[k] = locals[k].information;
  const double usual = median(room);
  for (std::size_t k = 0; k < locals.size(); ++k)
    weight[k] = prior[k] = locals[k].information / (locals[k].information + usual);
  EpipolarShift shift;
  describe_face(locals, prior, shift);
  const Fit fit = reweighted(locals, slopes, shift, prior, weight, room);
  Eigen::Matrix3d c;
  if (!sandwich(locals, slopes, shift, fit, weight, c)) return {};
  shift.offset_px = fit.field(0);
  shift.slope_x = fit.field(1) / shift.spread_x_px;
  shift.slope_y = fit.field(2) / shift.spread_y_px;
  shift.covariance_px2 = {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)};
  shift.residual_px = std::sqrt(fit.field.dot(moments(shift) * fit.field));
  shift.sigma_px = std::sqrt(std::max((c * moments(shift)).trace(), kLeastScalePx * kLeastScalePx));
  return shift;
}

EpipolarShift sum_of(const EpipolarShift& first, const EpipolarShift& second) {
  EpipolarShift sum = second;
  sum.offset_px += first.at(second.middle_x_px, second.middle_y_px);
  sum.slope_x += first.slope_x;
  sum.slope_y += first.slope_y;
  const Eigen::Vector3d field(sum.offset_px, sum.slope_x * sum.spread_x_px, sum.slope_y * sum.spread_y_px);
  sum.residual_px = std::sqrt(field.dot(moments(sum) * field));
  return sum;
}

}  // namespace relievo::pipeline
