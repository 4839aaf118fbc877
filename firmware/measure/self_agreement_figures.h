// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figures of self_agreement.h, as plain data.
#pragma once

#include <cstddef>

namespace relievo::firmware::compare {

struct LeftRightFigures {
  std::size_t asked = 0;     // pixels of the left view with a disparity
  std::size_t answered = 0;  // whose partner has one too
  double median_px = 0;      // of the difference of the two
  double p95_px = 0;
  double within_1px = 0;  // share of the answered
};

struct PhotoFigures {
  std::size_t asked = 0;  // windows that the model fills
  double median = 0;      // correlation, -1 .. 1
  double p5 = 0;          // of a twentieth it is lower
};

}  // namespace relievo::firmware::compare
