// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between two rows of a picture: Keys' cubic convolution of fourth order over six rows (1981, section
// VI). The usual one over four moves fine detail a tenth too little, and a shift measured with it is a
// tenth too large.
#pragma once

#include <cstddef>

namespace relievo::pipeline {

inline constexpr int kColumnReach = 3;  // rows needed on either side

struct ColumnWeights {
  // t in [0, 1): the way from the row above to the one below.
  explicit ColumnWeights(float t)
      : w{outer(t), middle(t), inner(t), inner(1 - t), middle(1 - t), outer(1 - t)} {}
  float sample(const float* above, std::ptrdiff_t stride) const {
    return w[0] * above[-2 * stride] + w[1] * above[-stride] + w[2] * above[0] + w[3] * above[stride] +
           w[4] * above[2 * stride] + w[5] * above[3 * stride];
  }

 private:
  static float inner(float s) { return 1 + s * s * (4.0F / 3 * s - 7.0F / 3); }  // at distance s
  static float middle(float s) { return s * (-2.0F / 3 + s * (15.0F / 12 - 7.0F / 12 * s)); }  // at 1 + s
  static float outer(float s) { return s * (1.0F / 12 + s * (-2.0F / 12 + 1.0F / 12 * s)); }   // at 2 + s
  float w[6];
};

}  // namespace relievo::pipeline
