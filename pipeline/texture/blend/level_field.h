// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LevelField: by how much the (exposure-matched) right photograph is brighter than the left one, channel by
// channel, slowly varying over the face; continued smoothly to where one alone sees it. Half added here and
// half taken off there leaves no seam where one gives way to the other: the low band of Burt and Adelson (A
// multiresolution spline with application to image mosaics, ACM TOG 1983), continued as Lempitsky and Ivanov
// level seams (Seamless mosaicing of image-based texture maps, CVPR 2007).
#pragma once

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/texture/blend/shot_planes.h"

namespace relievo::pipeline {

// Brings the right photograph to the left one's exposure and white balance: a gain and an offset per
// channel, found on skin that both see. Reduced major axis (both pictures are noisy), repeated with Tukey's
// weights, against highlights, hair and edges (Huber, Ronchetti: Robust Statistics, 2009, ch. 7). Grey
// levels.
struct ExposureMatch {
  std::array<float, 3> gain{1, 1, 1};
  std::array<float, 3> offset{0, 0, 0};
  std::array<float, 3> sigma{0, 0, 0};  // of left minus matched right, robust
  float matched(std::size_t channel, std::uint8_t right) const {
    return gain[channel] * float(right) + offset[channel];
  }
};

ExposureMatch match_exposure(const Chart& chart, const ShotPlanes& planes);

inline constexpr int kLevelCell = 16;  // texels a cell and side

class LevelField {
 public:
  using Level = std::array<float, 3>;
  // `shines`: one a texel, 1 where a highlight makes the views incomparable.
  LevelField(const Chart& chart, const ShotPlanes& planes, const ExposureMatch& exposure,
             std::span<const std::uint8_t> shines, std::pmr::memory_resource* memory);
  Level at(float texel_x, float texel_y) const;

 private:
  struct Cell {
    Level sum{0, 0, 0};
    float weight = 0;
  };
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(columns_) + std::size_t(x); }
  const Cell& cell(int x, int y) const { return cells_[index(x, y)]; }
  void smooth(std::pmr::memory_resource* memory);
  void extend(std::pmr::memory_resource* memory);
  int columns_, rows_;
  std::pmr::vector<Cell> cells_;
};

}  // namespace relievo::pipeline
