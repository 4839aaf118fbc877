// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/checks/deviation_picture.h"

#include <algorithm>
#include <cmath>

namespace relievo::firmware {
namespace {

constexpr int kGap = 8, kScaleHeight = 14, kDot = 2;

std::size_t offset(int width, int x, int y) {
  return 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
}

PixelBox cut(PixelBox box, int width, int height) {
  box.left = std::clamp(box.left, 0, width);
  box.right = std::clamp(box.right, box.left, width);
  box.top = std::clamp(box.top, 0, height);
  box.bottom = std::clamp(box.bottom, box.top, height);
  return box;
}

}  // namespace

std::array<std::uint8_t, 3> deviation_colour(double share) {
  const double s = std::clamp(share, -1.0, 1.0);
  const double fade = 1 - std::abs(s);
  const auto level = [](double v) { return std::uint8_t(std::lround(255 * v)); };
  // Half-way the colour itself still grows darker, so that the ends are told from three quarters.
  const double end = 1 - 0.25 * std::abs(s);
  return s < 0 ? std::array{level(fade * end), level(fade * end), level(end)}
               : std::array{level(end), level(fade * end), level(fade * end)};
}

DeviationPicture::DeviationPicture(std::span<const std::uint8_t> rgb, int width_px, int height_px,
                                   PixelBox box)
    : box_(cut(box, width_px, height_px)) {
  const int w = box_.right - box_.left, h = box_.bottom - box_.top;
  picture_.width_px = 2 * w + kGap;
  picture_.height_px = h + kGap + kScaleHeight;
  picture_.bytes.assign(offset(picture_.width_px, 0, picture_.height_px), std::byte{255});
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::uint8_t* from = &rgb[offset(width_px, box_.left + x, box_.top + y)];
      const auto grey = std::uint8_t((from[0] + from[1] + from[2]) / 6 + 30);  // paler: the colours lie on it
      for (std::size_t c = 0; c < 3; ++c) {
        picture_.bytes[offset(picture_.width_px, x, y) + c] = std::byte{from[c]};
        picture_.bytes[offset(picture_.width_px, w + kGap + x, y) + c] = std::byte{grey};
      }
    }
}

std::uint8_t* DeviationPicture::pixel(int x, int y) {
  return reinterpret_cast<std::uint8_t*>(
      &picture_.bytes[offset(picture_.width_px, box_.right - box_.left + kGap + x, y)]);
}

void DeviationPicture::mark(double x_px, double y_px, double share) {
  const auto colour = deviation_colour(share);
  const int x0 = int(std::lround(x_px)) - box_.left, y0 = int(std::lround(y_px)) - box_.top;
  for (int y = std::max(0, y0); y < std::min(y0 + kDot, box_.bottom - box_.top); ++y)
    for (int x = std::max(0, x0); x < std::min(x0 + kDot, box_.right - box_.left); ++x)
      std::ranges::copy(colour, pixel(x, y));
}

hal::Picture DeviationPicture::finish() {
  const int w = box_.right - box_.left, h = box_.bottom - box_.top;
  for (int y = h + kGap; y < h + kGap + kScaleHeight; ++y)
    for (int x = 0; x < w; ++x) {
      const auto colour = deviation_colour(w > 1 ? 2.0 * x / (w - 1) - 1 : 0);
      std::ranges::copy(colour, pixel(x, y));
    }
  return std::move(picture_);
}

}  // namespace relievo::firmware
