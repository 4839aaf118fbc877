// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/base/solving.h"

#include <Eigen/Cholesky>

namespace relievo::pipeline {

template <int kSize>
ColumnOf<kSize> solved(const SquareOf<kSize>& a, const ColumnOf<kSize>& b) {
  return a.ldlt().solve(b);
}
template ColumnOf<3> solved<3>(const SquareOf<3>&, const ColumnOf<3>&);
template ColumnOf<5> solved<5>(const SquareOf<5>&, const ColumnOf<5>&);
template ColumnOf<6> solved<6>(const SquareOf<6>&, const ColumnOf<6>&);
template ColumnOf<8> solved<8>(const SquareOf<8>&, const ColumnOf<8>&);
template ColumnOf<24> solved<24>(const SquareOf<24>&, const ColumnOf<24>&);

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
