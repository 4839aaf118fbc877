// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/relief/small_pair.h"

#include <algorithm>
#include <memory_resource>
#include <vector>

#include "hal/base/simd.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 8;

// Adds a row of samples to the sums: the part that touches every pixel of the large picture.
template <typename Sample>
RELIEVO_SIMD void add_row(const Sample* from, int count, std::uint32_t* sums) {
  for (int i = 0; i < count; ++i) sums[i] += from[i];
}

template <typename Sample>
void reduce_row(const ImageView& image, int y, int factor, int channels, std::uint32_t* sums, Sample* to) {
  const int width = image.width_px / factor;
  const int samples = width * factor * channels;
  std::fill(sums, sums + samples, 0U);
  for (int j = 0; j < factor; ++j)
    add_row(reinterpret_cast<const Sample*>(image.row(y * factor + j)), samples, sums);
  const auto area = static_cast<std::uint32_t>(factor * factor);
  for (int x = 0; x < width; ++x)
    for (int c = 0; c < channels; ++c) {
      std::uint32_t sum = area / 2;
      for (int i = 0; i < factor; ++i) sum += sums[(x * factor + i) * channels + c];
      to[x * channels + c] = static_cast<Sample>(sum / area);
    }
}

CameraIntrinsics reduced(CameraIntrinsics camera, int factor) {
  const auto centre = [factor](double at) { return (at + 0.5) / factor - 0.5; };
  camera.focal_px = {camera.focal_px.x / factor, camera.focal_px.y / factor};
  camera.centre_px = {centre(camera.centre_px.x), centre(camera.centre_px.y)};
  camera.width_px /= factor;
  camera.height_px /= factor;
  return camera;
}

}  // namespace

ImageView reduced(const ImageView& image, int factor, StageContext& context) {
  if (factor == 1) return image;
  const int channels = image.format == PixelFormat::Rgb8 ? 3 : 1;
  ImageView small{nullptr, image.width_px / factor, image.height_px / factor, 0, image.format};
  small.stride_bytes = small.width_px * bytes_per_pixel(image.format);
  const auto bytes = static_cast<std::size_t>(small.stride_bytes) * static_cast<std::size_t>(small.height_px);
  auto* to = static_cast<std::byte*>(
      context.scratch.allocate(std::max<std::size_t>(bytes, 1), alignof(std::uint32_t)));
  const auto row_sums = static_cast<std::size_t>(image.width_px * channels);
  std::pmr::vector<std::uint32_t> sums(kBands * row_sums, 0, &context.scratch);
  context.pool.for_each_band(small.height_px, kBands, [&](int begin, int end, int band) {
    std::uint32_t* own = sums.data() + static_cast<std::size_t>(band) * row_sums;
    for (int y = begin; y < end; ++y) {
      std::byte* row = to + static_cast<std::ptrdiff_t>(y) * small.stride_bytes;
      if (image.format == PixelFormat::Grey16)
        reduce_row(image, y, factor, channels, own, reinterpret_cast<std::uint16_t*>(row));
      else reduce_row(image, y, factor, channels, own, reinterpret_cast<std::uint8_t*>(row));
    }
  });
  small.bytes = to;
  return small;
}

StereoCalibration reduced(const StereoCalibration& calibration, int factor) {
  StereoCalibration small = calibration;
  small.left = reduced(calibration.left, factor);
  small.right = reduced(calibration.right, factor);
  return small;
}

}  // namespace relievo::pipeline
