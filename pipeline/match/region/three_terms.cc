// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/region/three_terms.h"

#include <Eigen/QR>

namespace relievo::pipeline {

void ThreeTerms::add(const std::array<double, 3>& terms, double value, double weight) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) products_[at++] += weight * terms[i] * terms[j];
    values_[i] += weight * terms[i] * value;
  }
}

std::optional<std::array<double, 3>> ThreeTerms::solve() const {
  const auto& p = products_;
  Eigen::Matrix3d a;
  a << p[0], p[1], p[2], p[1], p[3], p[4], p[2], p[4], p[5];
  const Eigen::ColPivHouseholderQR<Eigen::Matrix3d> qr(a);
  if (!qr.isInvertible()) return std::nullopt;
  const Eigen::Vector3d k = qr.solve(Eigen::Vector3d(values_[0], values_[1], values_[2]));
  return std::array<double, 3>{k[0], k[1], k[2]};
}

}  // namespace relievo::pipeline
