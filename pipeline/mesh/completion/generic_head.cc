// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/completion/generic_head.h"

#include <algorithm>

#include "pipeline/mesh/completion/unrolled_head.h"

namespace relievo::pipeline {

namespace {

// Where a coordinate lies among the cells, and what the four around it count (Catmull and Rom 1974): a head
// has no creases where its cells meet.
struct Taps {
  std::array<std::size_t, 4> cell{};
  std::array<double, 4> weight{};
};

Taps taps_at(double share, int cells) {
  const double at = std::clamp(share, 0.0, 1.0) * (cells - 1);
  const int first = std::min(static_cast<int>(at), cells - 2);
  const double t = at - first;
  Taps taps;
  for (int k = 0; k < 4; ++k)
    taps.cell[static_cast<std::size_t>(k)] =
        static_cast<std::size_t>(std::clamp(first - 1 + k, 0, cells - 1));
  taps.weight = {0.5 * t * (t * (2 - t) - 1), 0.5 * (t * t * (3 * t - 5) + 2),
                 0.5 * t * (t * (4 - 3 * t) + 1), 0.5 * t * t * (t - 1)};
  return taps;
}

}  // namespace

HeadPlace head_place(double arc_mm, double y_mm) {
  const Taps across = taps_at((arc_mm + kHalfArc) / (2 * kHalfArc), kHeadColumns);
  const Taps up = taps_at((y_mm + kBelow) / (kBelow + kAbove), kHeadRows);
  HeadPlace place;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t cell = up.cell[j] * kHeadColumns + across.cell[i];
      const double weight = up.weight[j] * across.weight[i];
      place.mean_mm += weight * kHeadMeanUnit * kHeadMean[cell];
      place.left_mm += weight * kHeadMeanUnit * kHeadLeft[cell];
      for (std::size_t k = 0; k < kHeadModes; ++k)
        place.mode_mm[k] += weight * kHeadModeUnit * kHeadMode[k][cell];
    }
  return place;
}

}  // namespace relievo::pipeline
