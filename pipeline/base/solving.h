// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Symmetric positive systems of the few sizes that fits come in, by LDLT. They are made once (solving.cc):
// each costs a file that makes its own one to three seconds of the compiler. Another size is one more line
// there. Thread: any. Errors: none; what is singular gives what is not finite.
#pragma once

#include <Eigen/Core>

namespace relievo::pipeline {

template <int kSize>
using SquareOf = Eigen::Matrix<double, kSize, kSize>;
template <int kSize>
using ColumnOf = Eigen::Matrix<double, kSize, 1>;

// x of a x = b. Sizes: 3, 5, 6, 8, 24.
template <int kSize>
ColumnOf<kSize> solved(const SquareOf<kSize>& a, const ColumnOf<kSize>& b);
// Sizes: 6, 24.
template <int kSize>
SquareOf<kSize> inverted(const SquareOf<kSize>& a);
// b a⁻¹ bᵀ: what is lost of the outer unknowns' information when the inner ones, of information a, are
// eliminated. Inner and outer sizes: 6 and 6, 6 and 24.
template <int kInner, int kOuter>
SquareOf<kOuter> eliminated(const SquareOf<kInner>& a, const Eigen::Matrix<double, kOuter, kInner>& b);

}  // namespace relievo::pipeline
