// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace relievo::pipeline {

// Of four nodes in a row, `t` of the way from the second to the third (Keys 1981, a = -1/2). At a node exactly that node.
inline std::array<float, 4> cubic_weights(float t) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  return {0.5F * (-t3 + 2 * t2 - t), 0.5F * (3 * t3 - 5 * t2 + 2), 0.5F * (-3 * t3 + 4 * t2 + t), 0.5F * (t3 - t2)};
}

}  // namespace relievo::pipeline
