// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// DeviationPicture: a piece of a photograph, and beside it the same with measured points coloured by
// how far they are off: blue below, white right, red above; the colours' scale lies under it.
// Coordinates: pixels of the photograph given. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/picture_file.h"

namespace relievo::firmware {

struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;  // right and bottom lie outside
};

// -1 blue, 0 white, 1 red; beyond stays as it is there.
std::array<std::uint8_t, 3> deviation_colour(double share);

class DeviationPicture {
 public:
  // The box is cut to the photograph. rgb: 3 bytes a pixel.
  DeviationPicture(std::span<const std::uint8_t> rgb, int width_px, int height_px, PixelBox box);
  // `share` of the range, -1 to 1. The dot covers the lattice's step.
  void mark(double x_px, double y_px, double share);
  hal::Picture finish();

 private:
  std::uint8_t* pixel(int x, int y);  // of the right half
  PixelBox box_;
  hal::Picture picture_;
};

}  // namespace relievo::firmware
