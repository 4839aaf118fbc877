// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// face_light(): how a camera sees the face: how bright, how much of it is burnt out, how sharp. What the
// exposure is set by and what a hand at the lens looks at. Green stands for brightness in colour pictures.
// Errors: InvalidInput (no picture, or a box of which fewer than 16 x 16 pixels lie in it). Thread: any.
#pragma once

#include <cstdint>

#include "hal/base/image_view.h"
#include "hal/base/result.h"

namespace relievo::firmware {

// Brightness of a pixel, 0 to 255.
inline int level_of(const std::uint8_t* row, int x, PixelFormat format) {
  if (format == PixelFormat::Grey8) return row[x];
  return format == PixelFormat::Grey16 ? row[2 * x + 1] : row[3 * x + 1];  // the high byte; green
}

// Pixels; the part of it outside the picture is not looked at.
struct FaceBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
};
// Where a face is expected when none has been found: the middle, half as wide and high as the picture.
FaceBox middle_box(const ImageView& view);

struct FaceLight {
  double mean = 0;       // 0 to 1, 1 is white
  double bright = 0;     // 95 of 100 pixels are darker
  double highlight = 0;  // 99 of 100
  double clipped = 0;    // the share that is white, or within 1 of 100 of it
  // The mean squared gradient over the squared deviation, a number a pixel squared: of the same scene the
  // larger the sharper, however bright (Tenenbaum's measure, after Pertuz, Puig, Garcia 2013, made free of
  // brightness). Between scenes it means nothing.
  double sharpness = 0;
};
Result<FaceLight> face_light(const ImageView& view, const FaceBox& box);

// For a hand at the lens: how sharp it is against the sharpest seen since reset(), 1 is the best.
class FocusHelp {
 public:
  double share_of_best(const FaceLight& light);
  void reset() { best_ = 0; }

 private:
  double best_ = 0;
};

}  // namespace relievo::firmware
