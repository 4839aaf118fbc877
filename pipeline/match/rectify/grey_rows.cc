// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/rectify/grey_rows.h"

namespace relievo::pipeline {

void grey_rows(const ImageView& image, float* to, int stride, int begin, int end) {
  to += static_cast<std::ptrdiff_t>(begin) * stride;
  for (int y = begin; y < end; ++y, to += stride) {
    const std::uint8_t* from = image.row(y);
    if (image.format == PixelFormat::Rgb8) {
      for (int x = 0; x < image.width_px; ++x)
        to[x] = static_cast<float>(from[3 * x] + from[3 * x + 1] + from[3 * x + 2]) * (1.0F / 3);
    } else if (image.format == PixelFormat::Grey16) {
      const auto* wide = reinterpret_cast<const std::uint16_t*>(from);
      for (int x = 0; x < image.width_px; ++x) to[x] = static_cast<float>(wide[x]) * (1.0F / 257);
    } else {
      for (int x = 0; x < image.width_px; ++x) to[x] = static_cast<float>(from[x]);
    }
  }
}

}  // namespace relievo::pipeline
