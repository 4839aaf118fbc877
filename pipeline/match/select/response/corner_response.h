// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the selectors share: where a keypoint may lie, the peaks of a response, and a choice of the
// strongest that keep their distance. Pixels of the left rectified view; memory: the context's arenas;
// the same result for any number of threads.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/match_set.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Where a keypoint may lie: in the face region (everywhere where none is marked), and with all pixels
// around it that its response looks at inside the valid picture, whose edge would look like a corner.
class Selectable {
 public:
  Selectable(const RectifiedPair& pair, std::pmr::memory_resource* memory);
  std::size_t count() const { return count_; }  // without any margin
  bool operator()(int x, int y, int margin_px) const;
  // The square from (x, y), `side` pixels wide, is all valid; the region is not asked.
  bool valid_block(int x, int y, int side_px) const;

 private:
  const RectifiedPair& pair_;
  Plane<std::int32_t> valid_above_;  // valid pixels above and left of (x, y)
  std::size_t count_ = 0;
};

// Where every selector but those of a lattice begins.
// Errors: InvalidInput (no pixels), Cancelled, NoFace (nothing selectable).
Result<Selectable> selectable_of(const RectifiedPair& pair, StageContext& context);

struct Candidate {
  std::int32_t x, y;
  float strength;
};

// A peak is a pixel that no neighbour within `radius_px` (a square) exceeds, of equal ones the first, with
// more than `least` of the strongest. The strongest are taken first, each at least distance_px from all
// before it, until there are max_points; equal ones from the top left.
struct PeakChoice {
  double least = 0;
  int radius_px = 0;
  double distance_px = 0;
  int max_points = 0;
};

// Divides the response, which is 0 where nothing may be selected, by its greatest; marks the chosen peaks'
// strength in `chosen`. Error: Cancelled.
Result<void> mark_peaks(Plane<float>& response, const PeakChoice& choice, Plane<float>& chosen,
                        StageContext& context);

// What is marked (strength > 0), in rows from the top, at most the max_points strongest.
// Error: TooFewMatches where nothing is.
Result<Keypoints> keypoints_of(const Plane<float>& chosen, int max_points, StageContext& context);
// The chosen peaks of one response. Errors: TooFewMatches, Cancelled.
Result<Keypoints> peak_keypoints(Plane<float>& response, const PeakChoice& choice, StageContext& context);

// First and last pixels of a rectangle of the left view.
struct LatticeArea {
  int left, top, right, bottom;
};

// Every step_px pixels in both directions, from the area's upper left corner on.
// Errors: InvalidInput (no pixels), Cancelled, NoFace.
Result<Keypoints> lattice_keypoints(const RectifiedPair& pair, int step_px, const LatticeArea& area,
                                    StageContext& context);

// SalientTracks: the Haar wavelet transform of a picture and its tracks from coarse to fine. See selectors.h.
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

struct ResponseWindow {
  int radius_px = 3;
  int passes = 1;  // 1: a square, each pixel counts the same; 3: close to a Gaussian
  // How far from its centre a response looks, gradients included.
  int reach_px() const { return radius_px * passes + 1; }
};

// Corners by the structure tensor, the mean over a window of the products of Sobel's gradient, grey levels a
// pixel: its entries become the response. Memory: four planes of the picture's size in `scratch`.
using CornerMeasure = float (*)(float xx, float xy, float yy, float parameter);
float smaller_eigenvalue(float xx, float xy, float yy, float);          // Shi and Tomasi 1994
float harris_measure(float xx, float xy, float yy, float sensitivity);  // Harris and Stephens 1988

// Fills `response`: 0 where nothing may be selected and where the measure is negative. Error: Cancelled.
Result<void> corner_response(const std::pmr::vector<float>& grey, const Selectable& selectable,
                             const ResponseWindow& window, CornerMeasure measure, float parameter,
                             StageContext& context, Plane<float>& response);

}  // namespace relievo::pipeline
