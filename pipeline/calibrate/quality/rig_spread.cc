// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/rig_spread.h"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace relievo::pipeline {

RigSpread::RigSpread(const StereoFit& fit, bool slips) : likeliest_(fit.problem), slips_(slips) {
  std::vector<bundle::Problem> without = bundle::without_each_view(fit.problem);
  without.resize(fit.paired.size());
  without_ = std::move(without);
  likeliest_.views.clear();  // the globals are what is spread; poses would be copied for nothing
  for (bundle::Problem& one : without_) one.views.clear();
  // Parameters differ by orders of magnitude: equilibrate, or the small ones drown in rounding.
  const bundle::Globals& covariance = fit.problem.covariance;
  const bundle::GlobalVector unit = covariance.diagonal().cwiseMax(1e-30).cwiseSqrt();
  const bundle::Globals even =
      unit.cwiseInverse().asDiagonal() * covariance * unit.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<bundle::Globals> eigen(0.5 * (even + even.transpose()));
  for (int i = 0; i < bundle::kGlobals; ++i) {
    const double length = std::sqrt(std::max(0.0, eigen.eigenvalues()[i]) * fit.problem.noise_px2);
    const bundle::GlobalVector step = length * unit.cwiseProduct(eigen.eigenvectors().col(i));
    above_.push_back(likeliest_);
    bundle::step_globals(above_.back(), step);
    below_.push_back(likeliest_);
    bundle::step_globals(below_.back(), -step);
  }
}

Eigen::VectorXd RigSpread::variance(const Measure& measure) const {
  const Eigen::VectorXd middle = measure(likeliest_);
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(middle.size());
  for (std::size_t i = 0; i < above_.size(); ++i)
    noise += (0.5 * (measure(above_[i]) - measure(below_[i]))).cwiseAbs2();
  if (!slips_ || without_.size() < 2) return noise;
  Eigen::VectorXd spread = Eigen::VectorXd::Zero(middle.size());
  for (const bundle::Problem& one : without_) spread += (measure(one) - middle).cwiseAbs2();
  const double views = static_cast<double>(without_.size());
  return noise.cwiseMax((views - 1) / views * spread);
}

}  // namespace relievo::pipeline
