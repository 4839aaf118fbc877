// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture in 8 bit grey at full, half, quarter … size. Pixel (x, y) of a level lies at (2x, 2y) of
// the one below. Grey pictures are borrowed, others copied. Inside calibrate/board/ only.
// Thread: any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/base/image_view.h"

namespace relievo::pipeline {

struct GreyView {
  const std::uint8_t* pixels = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride = 0;

  const std::uint8_t* row(int y) const { return pixels + y * stride; }
};

// The binomial filter 1 4 6 4 1 down the columns about row y, times 16; the picture's edges repeat. `sum` has
// two places more to either side: the filter along the row needs them.
void smooth_columns(const GreyView& picture, int y, std::vector<std::uint16_t>& sum);

class GreyPyramid {
 public:
  explicit GreyPyramid(const ImageView& picture);  // not empty; must outlive this

  int levels() const { return int(views_.size()); }
  const GreyView& level(int k) const { return views_[std::size_t(k)]; }

 private:
  std::vector<std::vector<std::uint8_t>> own_;
  std::vector<GreyView> views_;
};

}  // namespace relievo::pipeline
