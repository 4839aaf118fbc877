// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/select/response/salient_tracks.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {

SalientTracks::SalientTracks(const std::pmr::vector<float>& grey, int width_px, int height_px, int scales,
                             std::pmr::memory_resource* memory)
    : means_(memory) {
  means_.reserve(static_cast<std::size_t>(scales) + 1);
  means_.emplace_back(memory, width_px, height_px);
  std::copy(grey.begin(), grey.end(), means_[0].values.begin());
  for (int s = 0; s < scales && means_.back().width >= 2 && means_.back().height >= 2; ++s) {
    const Plane<float>& from = means_.back();
    Plane<float> to(memory, from.width / 2, from.height / 2);
    for (int y = 0; y < to.height; ++y)
      for (int x = 0; x < to.width; ++x) {
        const float* upper = from.row(2 * y) + 2 * x;
        const float* lower = from.row(2 * y + 1) + 2 * x;
        to.row(y)[x] = 0.25F * (upper[0] + upper[1] + lower[0] + lower[1]);
      }
    means_.push_back(std::move(to));
  }
}

float SalientTracks::magnitude(int scale, int orientation, int column, int row) const {
  const Plane<float>& finer = means_[static_cast<std::size_t>(scale) - 1];
  const float* upper = finer.row(2 * row) + 2 * column;
  const float* lower = finer.row(2 * row + 1) + 2 * column;
  const float left = upper[0] + lower[0], right = upper[1] + lower[1];
  const float difference = orientation == 0   ? right - left
                           : orientation == 1 ? lower[0] + lower[1] - upper[0] - upper[1]
                                              : upper[0] + lower[1] - upper[1] - lower[0];
  return std::ldexp(std::abs(difference),
                    scale - 2);  // means of 4^(scale-1) pixels; 1/2 a level keeps energy
}

Candidate SalientTracks::follow(int scale, int orientation, int column, int row) const {
  float saliency = magnitude(scale, orientation, column, row);
  for (; scale > 1; --scale) {
    float greatest = 0;
    const int first_column = 2 * column;
    const int first_row = 2 * row;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        if (const float m = magnitude(scale - 1, orientation, first_column + i, first_row + j);
            m > greatest) {
          greatest = m;
          column = first_column + i;
          row = first_row + j;
        }
    if (!(greatest > 0)) break;
    saliency += greatest;
  }
  Candidate end = end_of(scale, column, row);
  end.strength = saliency;
  return end;
}

// Of the pixels under a coefficient the one with the greatest gradient.
Candidate SalientTracks::end_of(int scale, int column, int row) const {
  const Plane<float>& picture = means_[0];
  const int side = 1 << scale;
  Candidate best{side * column, side * row, -1};
  for (int y = side * row; y < side * (row + 1); ++y)
    for (int x = side * column; x < side * (column + 1); ++x) {
      const float dx =
          picture.row(y)[std::min(x + 1, picture.width - 1)] - picture.row(y)[std::max(x - 1, 0)];
      const float dy =
          picture.row(std::min(y + 1, picture.height - 1))[x] - picture.row(std::max(y - 1, 0))[x];
      if (const float gradient = dx * dx + dy * dy; gradient > best.strength) best = {x, y, gradient};
    }
  return best;
}

}  // namespace relievo::pipeline
