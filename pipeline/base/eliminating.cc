// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Cholesky>

#include "pipeline/base/solving.h"

namespace relievo::pipeline {

template <int kSize>
SquareOf<kSize> inverted(const SquareOf<kSize>& a) {
  return a.ldlt().solve(SquareOf<kSize>::Identity());
}
template SquareOf<6> inverted<6>(const SquareOf<6>&);
template SquareOf<24> inverted<24>(const SquareOf<24>&);

template <int kInner, int kOuter>
SquareOf<kOuter> eliminated(const SquareOf<kInner>& a, const Eigen::Matrix<double, kOuter, kInner>& b) {
  return b * a.ldlt().solve(b.transpose());
}
template SquareOf<6> eliminated<6, 6>(const SquareOf<6>&, const SquareOf<6>&);
template SquareOf<24> eliminated<6, 24>(const SquareOf<6>&, const Eigen::Matrix<double, 24, 6>&);

}  // namespace relievo::pipeline
