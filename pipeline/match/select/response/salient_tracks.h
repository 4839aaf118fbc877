// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SalientTracks: the Haar wavelet transform of a picture and the tracks through it from coarse to fine.
// See selectors.h.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/match/image/plane.h"
#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {

class SalientTracks {
 public:
  static constexpr int kOrientations = 3;  // changes along x, along y, along both

  SalientTracks(const std::pmr::vector<float>& grey, int width_px, int height_px, int scales,
                std::pmr::memory_resource* memory);

  int scales() const { return static_cast<int>(means_.size()) - 1; }
  // How many coefficients a scale (1 is the finest) has.
  int columns(int scale) const { return means_[static_cast<std::size_t>(scale)].width; }
  int rows(int scale) const { return means_[static_cast<std::size_t>(scale)].height; }
  // Magnitude in the orthonormal transform; its square sums up to the picture's energy over all scales.
  float magnitude(int scale, int orientation, int column, int row) const;
  // Where the track from this coefficient ends, and the sum of the magnitudes along it. Where all four
  // children vanish (drawn pictures) the track ends early, at the greatest gradient under the coefficient.
  Candidate follow(int scale, int orientation, int column, int row) const;

 private:
  Candidate end_of(int scale, int column, int row) const;

  std::pmr::vector<Plane<float>> means_;  // [0] the picture, [s] means of 2^s squared pixels
};

}  // namespace relievo::pipeline
