// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners by the structure tensor (the mean over a window of the gradient's products): what the two
// corner selectors share. Gradients are Sobel's, in grey levels a pixel.
// Memory: four planes of the picture's size in `scratch` while it works. Thread: any; bands on the pool.
#pragma once

#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/select/response/keypoint_choice.h"

namespace relievo::pipeline {

// SalientTracks: the Haar wavelet transform of a picture and the tracks through it from coarse to fine.
// See selectors.h.
class SalientTracks {
 public:
  static constexpr int kOrientations = 3;  // changes along x, along y, along both

  SalientTracks(const std::pmr::vector<float>& grey, int width_px, int height_px, int scales,
                std::pmr::memory_resource* memory);

  int scales() const { return int(means_.size()) - 1; }
  // How many coefficients a scale (1 is the finest) has.
  int columns(int scale) const { return means_[std::size_t(scale)].width; }
  int rows(int scale) const { return means_[std::size_t(scale)].height; }
  // Magnitude in the orthonormal transform; its square sums up to the picture's energy over all scales.
  float magnitude(int scale, int orientation, int column, int row) const;
  // Where the track from this coefficient ends, and the sum of the magnitudes along it. Where all four
  // children vanish (drawn pictures) the track ends early, at the greatest gradient under the coefficient.
  Candidate follow(int scale, int orientation, int column, int row) const;

 private:
  Candidate end_of(int scale, int column, int row) const;

  std::pmr::vector<Plane<float>> means_;  // [0] the picture, [s] means of 2^s squared pixels
};

// FastHessian: second derivatives of a picture by box filters on its integral image (Bay et al. 2008),
// at any size for the same cost. See selectors.h.
class FastHessian {
 public:
  FastHessian(const std::pmr::vector<float>& grey, int width_px, int height_px,
              std::pmr::memory_resource* memory);

  // Determinant of the Hessian at whole pixels, by filters `size_px` wide (9, 15, 21, ...: odd multiples
  // of 3), normalised by their area: it does not depend on the size of what it is laid upon. The
  // filter must lie inside the picture: at least size_px / 2 pixels from its edges.
  float determinant(int x, int y, int size_px) const;

 private:
  // Over left <= x < left + width, top <= y < top + height.
  double sum(int left, int top, int width, int height) const;

  Plane<double> above_;  // sum of all pixels above and left of (x, y)
};

struct CornerWindow {
  int radius_px = 3;
  int passes = 1;  // 1: a square, each pixel counts the same; 3: close to a Gaussian
  // How far from its centre a response looks, gradients included.
  int reach_px() const { return radius_px * passes + 1; }
};

// The tensor's entries at a pixel become the response.
using CornerMeasure = float (*)(float xx, float xy, float yy, float parameter);
float smaller_eigenvalue(float xx, float xy, float yy, float);          // Shi and Tomasi 1994
float harris_measure(float xx, float xy, float yy, float sensitivity);  // Harris and Stephens 1988

// Fills `response`: 0 where nothing may be selected and where the measure is negative. False: cancelled.
bool corner_response(const std::pmr::vector<float>& grey, const Selectable& selectable,
                     const CornerWindow& window, CornerMeasure measure, float parameter,
                     StageContext& context, Plane<float>& response);

}  // namespace relievo::pipeline
