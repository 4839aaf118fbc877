// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture in 8 bit grey at full, half, quarter … size. Pixel (x, y) of a level lies at (2x, 2y) of
// the one below. Grey pictures are borrowed, others copied. Inside calibrate/board/ only.
// Thread: any.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"

namespace relievo::pipeline {

// The binomial filter 1 4 6 4 1 down the columns about row y, times 16; the picture's edges repeat. `sum` has
// two places more to either side: the filter along the row needs them.
void smooth_columns(const ImageView& picture, int y, std::vector<std::uint16_t>& sum);

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

}  // namespace relievo::pipeline
