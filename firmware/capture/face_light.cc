// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/capture/face_light.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace relievo::firmware {
namespace {

constexpr int kLeastSide = 16;
constexpr int kWhiteFrom = 252;
constexpr double kBrightShare = 0.95;
constexpr double kHighlightShare = 0.99;

}  // namespace

FaceBox middle_box(const ImageView& view) {
  return {view.width_px / 4, view.height_px / 4, view.width_px / 2, view.height_px / 2};
}

Result<FaceLight> face_light(const ImageView& view, const FaceBox& box) {
  const int left = std::max(box.x_px, 0);
  const int top = std::max(box.y_px, 0);
  const int right = std::min(box.x_px + box.width_px, view.width_px);
  const int bottom = std::min(box.y_px + box.height_px, view.height_px);
  if (view.empty() || right - left < kLeastSide || bottom - top < kLeastSide)
    return Error{Errc::InvalidInput, "the face is not in the picture: its light cannot be measured"};
  std::array<long, 256> histogram{};
  double gradient = 0;
  for (int y = top; y < bottom; ++y) {
    const std::uint8_t* row = view.row(y);
    const std::uint8_t* below = view.row(std::min(y + 1, bottom - 1));
    for (int x = left; x < right; ++x) {
      const int here = level_of(row, x, view.format);
      ++histogram[static_cast<std::size_t>(here)];
      const int dx = level_of(row, std::min(x + 1, right - 1), view.format) - here;
      const int dy = level_of(below, x, view.format) - here;
      gradient += dx * dx + dy * dy;
    }
  }
  const double count = static_cast<double>(right - left) * (bottom - top);
  FaceLight light;
  double sum = 0;
  double squares = 0;
  double darker = 0;
  for (int v = 0; v < 256; ++v) {
    const auto n = static_cast<double>(histogram[static_cast<std::size_t>(v)]);
    sum += n * v;
    squares += n * v * v;
    if (n > 0 && darker < kBrightShare * count) light.bright = v / 255.0;
    if (n > 0 && darker < kHighlightShare * count) light.highlight = v / 255.0;
    darker += n;
    if (v >= kWhiteFrom) light.clipped += n / count;
  }
  const double mean = sum / count;
  const double variance = squares / count - mean * mean;
  light.mean = mean / 255;
  light.sharpness = variance > 0 ? gradient / count / variance : 0;
  return light;
}

double FocusHelp::share_of_best(const FaceLight& light) {
  best_ = std::max(best_, light.sharpness);
  return best_ > 0 ? light.sharpness / best_ : 0;
}

}  // namespace relievo::firmware
