// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Places where two edges cross and dark meets dark across a corner: what every inner corner of a
// chessboard looks like, whatever its tilt, blur and light. Inside calibrate/board/ only.
//
// Candidates are saddles of the smoothed brightness (negative determinant of the Hessian); each must then
// show two dark and two bright sectors, alike across the middle, on a circle around it. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

// A picture in 8 bit grey at full, half, quarter … size. Pixel (x, y) of a level lies at (2x, 2y) of
// the one below. Grey pictures are borrowed, others copied.
class GreyPyramid {
 public:
  explicit GreyPyramid(const ImageView& picture);  // not empty; must outlive this

  int levels() const { return int(views_.size()); }
  const ImageView& level(int k) const { return views_[std::size_t(k)]; }

 private:
  void keep(std::vector<std::uint8_t> grey, int width_px, int height_px);

  std::vector<std::vector<std::uint8_t>> own_;
  std::vector<ImageView> views_;
};

// Brightness times 16, slightly smoothed.
class SmoothPicture {
 public:
  explicit SmoothPicture(const ImageView& grey);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  const std::int16_t* row(int y) const {
    return values_.data() + std::ptrdiff_t(y) * std::ptrdiff_t(width_px_);
  }
  bool holds(float x, float y) const {
    return x >= 1 && y >= 1 && x < float(width_px_ - 2) && y < float(height_px_ - 2);
  }
  float at(float x, float y) const;  // bilinear; the place must be held

 private:
  int width_px_;
  int height_px_;
  std::vector<std::int16_t> values_;
};

struct Saddle {
  float x = 0, y = 0;  // px of the level
  float contrast = 0;  // between bright and dark, in the picture's grey levels
  // Where two of the half edges go, unit vectors: turning from the first to the second, x towards y, one
  // crosses a dark sector. The other two half edges go the opposite ways.
  std::array<Vec2f, 2> edge{};

  // Half edge k of four in turn: dark lies between 0 and 1 and between 2 and 3.
  Vec2f ray(int k) const {
    const Vec2f& e = edge[std::size_t(k % 2)];
    return k < 2 ? e : Vec2f{-e.x, -e.y};
  }
};

// The strongest `most` of all.
std::vector<Saddle> find_saddles(const SmoothPicture& picture, std::size_t most);

}  // namespace relievo::pipeline
