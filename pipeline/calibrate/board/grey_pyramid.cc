// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/board/grey_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

// A board in a smaller picture than this has squares too small to be found.
constexpr int kMinSidePx = 160;
// Of all 16 bit pixels, this share may lie outside the 8 bit range: one hot pixel must not decide it.
constexpr double kClippedShare = 1e-3;

RELIEVO_SIMD void grey_of_rgb(const std::uint8_t* rgb, int count, std::uint8_t* grey) {
  for (int x = 0; x < count; ++x)
    grey[x] = std::uint8_t((77 * rgb[3 * x] + 150 * rgb[3 * x + 1] + 29 * rgb[3 * x + 2] + 128) >> 8);
}

int value_of(const std::uint8_t* row, int x) { return row[2 * x] | row[2 * x + 1] << 8; }

// The range that holds all but the clipped shares of a 16 bit picture, in steps of 256 at most.
std::array<int, 2> range_of(const ImageView& picture) {
  std::vector<std::size_t> count(65536);
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) ++count[std::size_t(value_of(picture.row(y), x))];
  const double pixels = double(picture.width_px) * picture.height_px;
  std::array<int, 2> range{0, 65535};
  for (double sum = 0; range[0] < 65535; ++range[0])
    if ((sum += double(count[std::size_t(range[0])])) > kClippedShare * pixels) break;
  for (double sum = 0; range[1] > range[0]; --range[1])
    if ((sum += double(count[std::size_t(range[1])])) > kClippedShare * pixels) break;
  return range;
}

std::vector<std::uint8_t> grey_of(const ImageView& picture) {
  const auto width = std::size_t(picture.width_px);
  std::vector<std::uint8_t> grey(width * std::size_t(picture.height_px));
  if (picture.format == PixelFormat::Rgb8) {
    for (int y = 0; y < picture.height_px; ++y)
      grey_of_rgb(picture.row(y), picture.width_px, &grey[std::size_t(y) * width]);
    return grey;
  }
  const auto [low, high] = range_of(picture);
  const double scale = high > low ? 255.0 / (high - low) : 0;
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x)
      grey[std::size_t(y) * width + std::size_t(x)] =
          std::uint8_t(std::lround(std::clamp((value_of(picture.row(y), x) - low) * scale, 0.0, 255.0)));
  return grey;
}

RELIEVO_SIMD void weigh_rows(const std::uint8_t* const* rows, int width, std::uint16_t* sum) {
  for (int x = 0; x < width; ++x)
    sum[x] = std::uint16_t(rows[0][x] + 4 * rows[1][x] + 6 * rows[2][x] + 4 * rows[3][x] + rows[4][x]);
}

RELIEVO_SIMD void weigh_columns(const std::uint16_t* sum, int half_width, std::uint8_t* out) {
  for (int x = 0; x < half_width; ++x) {
    const std::uint16_t* s = sum + 2 * x;
    out[x] = std::uint8_t((s[0] + 4 * s[1] + 6 * s[2] + 4 * s[3] + s[4] + 128) >> 8);
  }
}

// Every second pixel of every second row after the binomial filter 1 4 6 4 1; the edges repeat.
std::vector<std::uint8_t> half_of(const ImageView& from, int width, int height) {
  std::vector<std::uint8_t> out(std::size_t(width) * std::size_t(height));
  std::vector<std::uint16_t> sum(std::size_t(from.width_px) + 4);
  for (int y = 0; y < height; ++y) {
    smooth_columns(from, 2 * y, sum);
    weigh_columns(sum.data(), width, &out[std::size_t(y) * std::size_t(width)]);
  }
  return out;
}

}  // namespace

void smooth_columns(const ImageView& picture, int y, std::vector<std::uint16_t>& sum) {
  std::array<const std::uint8_t*, 5> rows{};
  for (int k = 0; k < 5; ++k)
    rows[std::size_t(k)] = picture.row(std::clamp(y + k - 2, 0, picture.height_px - 1));
  weigh_rows(rows.data(), picture.width_px, sum.data() + 2);
  sum[0] = sum[1] = sum[2];
  sum.end()[-1] = sum.end()[-2] = sum.end()[-3];
}

GreyPyramid::GreyPyramid(const ImageView& picture) {
  if (picture.format == PixelFormat::Grey8) views_.push_back(picture);
  else keep(grey_of(picture), picture.width_px, picture.height_px);
  while (std::min(views_.back().width_px, views_.back().height_px) >= 2 * kMinSidePx) {
    const int width = (views_.back().width_px + 1) / 2;
    const int height = (views_.back().height_px + 1) / 2;
    keep(half_of(views_.back(), width, height), width, height);
  }
}

void GreyPyramid::keep(std::vector<std::uint8_t> grey, int width_px, int height_px) {
  own_.push_back(std::move(grey));
  views_.push_back({reinterpret_cast<const std::byte*>(own_.back().data()), width_px, height_px, width_px});
}

}  // namespace relievo::pipeline
