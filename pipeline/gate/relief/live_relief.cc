// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/relief/live_relief.h"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <vector>

#include "hal/base/simd.h"
#include "pipeline/base/parts.h"
#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/rectify/rectifier.h"

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
  const auto area = std::uint32_t(factor * factor);
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

// The pair is a quarter of the size already: two halvings of it are a sixteenth.
constexpr int kLevels = 3;
constexpr int kBand = 12;
constexpr float kCrossCheckPx = 1.5F;  // how far the views may disagree, pixels of each size
constexpr float kStepPx = 1.5F;    // neighbours whose disparities differ by more are of different surfaces
constexpr double kSpeckMm2 = 400;  // connected surfaces smaller than this are not believed

void fill_depth(const RectifiedPair& pair, const Plane<float>& disparity, Relief& relief) {
  relief.width_px = pair.width_px;
  relief.height_px = pair.height_px;
  relief.focal_px = pair.focal_px;
  relief.baseline_mm = pair.baseline_mm;
  relief.centre_px = pair.left_centre_px;
  relief.rectified_from_left = pair.rectified_from_left;
  const std::size_t count = pair.left.grey.size();
  relief.depth_mm.resize(count);
  relief.surface.resize(count);
  relief.grey.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    relief.grey[i] = std::uint8_t(std::clamp(pair.left.grey[i] + 0.5F, 0.0F, 255.0F));
    const float d = disparity.values[i];
    if (d == kNoDisparity) continue;
    const double z = pair.depth_mm(double(d));
    if (z >= pair.near_mm && z <= pair.far_mm) relief.depth_mm[i] = float(z);
  }
}

struct Found {
  std::uint32_t pixels = 0;
  double area_mm2 = 0;
  std::uint16_t name = 0;
};

}  // namespace

void draw_relief(const Relief& relief, double near_mm, double far_mm, std::uint8_t* grey) {
  const double scale = 215 / (1 / near_mm - 1 / far_mm);
  for (std::size_t i = 0; i < relief.depth_mm.size(); ++i) {
    const double z = double(relief.depth_mm[i]);
    grey[i] = z > 0 ? std::uint8_t(std::lround(std::clamp(40 + scale * (1 / z - 1 / far_mm), 20.0, 255.0)))
                    : std::uint8_t{0};
  }
}

ImageView reduced(const ImageView& image, int factor, StageContext& context) {
  if (factor == 1) return image;
  const int channels = image.format == PixelFormat::Rgb8 ? 3 : 1;
  ImageView small{nullptr, image.width_px / factor, image.height_px / factor, 0, image.format};
  small.stride_bytes = small.width_px * bytes_per_pixel(image.format);
  const auto bytes = std::size_t(small.stride_bytes) * std::size_t(small.height_px);
  auto* to = static_cast<std::byte*>(
      context.scratch.allocate(std::max<std::size_t>(bytes, 1), alignof(std::uint32_t)));
  const auto row_sums = std::size_t(image.width_px * channels);
  std::pmr::vector<std::uint32_t> sums(kBands * row_sums, 0, &context.scratch);
  context.pool.for_each(small.height_px, kBands, [&](int y, int band) {
    std::uint32_t* own = sums.data() + std::size_t(band) * row_sums;
    std::byte* row = to + std::ptrdiff_t(y) * small.stride_bytes;
    if (image.format == PixelFormat::Grey16)
      reduce_row(image, y, factor, channels, own, reinterpret_cast<std::uint16_t*>(row));
    else reduce_row(image, y, factor, channels, own, reinterpret_cast<std::uint8_t*>(row));
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

Result<void> LiveRelief::check() const {
  if (reduction < 1 || reduction > 16) return invalid("reduction must lie in 1 .. 16").at("live-relief");
  return {};
}

void label_surfaces(Relief& relief, StageContext& context) {
  const std::size_t count = relief.depth_mm.size();
  // Of inverse depth, one pixel of disparity is the same everywhere.
  const auto step = float(double(kStepPx) / (relief.focal_px * relief.baseline_mm));
  std::pmr::vector<std::uint32_t> label(count, 0, &context.scratch);
  std::pmr::vector<Found> found(1, Found{}, &context.scratch);
  found.reserve(count + 1);
  label_parts(
      std::span(label), std::size_t(relief.width_px), &context.scratch,
      [&](std::size_t k) { return relief.depth_mm[k] > 0; },
      [&](std::size_t a, std::size_t b) {
        return !(std::abs(1 / relief.depth_mm[a] - 1 / relief.depth_mm[b]) > step);
      },
      [&](std::span<const std::uint32_t> cells) {
        double area = 0;
        for (const std::uint32_t at : cells) {
          const double pixel_mm = double(relief.depth_mm[at]) / relief.focal_px;
          area += pixel_mm * pixel_mm;
        }
        found.push_back({std::uint32_t(cells.size()), area, 0});
      });
  // Names in the order of size; specks get none. The first of `found` is no surface.
  std::pmr::vector<std::uint32_t> order(&context.scratch);
  order.reserve(found.size());
  for (std::uint32_t i = 1; i < found.size(); ++i)
    if (found[i].area_mm2 >= kSpeckMm2) order.push_back(i);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return found[a].pixels != found[b].pixels ? found[a].pixels > found[b].pixels : a < b;
  });
  const std::size_t kept = std::min<std::size_t>(order.size(), 65535);
  for (std::size_t i = 0; i < kept; ++i) found[order[i]].name = std::uint16_t(i + 1);
  for (std::size_t i = 0; i < count; ++i) {
    relief.surface[i] = found[label[i]].name;
    if (relief.surface[i] == 0) relief.depth_mm[i] = 0;
  }
}

Result<Relief> LiveRelief::look(const StereoFrame& frame, const StereoCalibration& calibration,
                                StageContext& context) const {
  RELIEVO_TRY(check());
  if (frame.left.empty() || frame.right.empty())
    return invalid("a live picture has no pixels: is a camera unplugged?").at("live-relief");
  if (frame.left.width_px != calibration.left.width_px ||
      frame.left.height_px != calibration.left.height_px ||
      frame.right.width_px != calibration.right.width_px ||
      frame.right.height_px != calibration.right.height_px)
    return invalid("the live picture's size is not the calibration's: calibrate at this size")
        .at("live-relief");
  const StereoFrame small{reduced(frame.left, reduction, context), reduced(frame.right, reduction, context),
                          frame.sequence, frame.skew_ns};
  // The rectified pair is needed no longer than the matching: it lives on the scratch.
  StageContext inner{context.scratch, context.scratch, context.pool, context.progress, context.cancelled};
  const RectifierOptions volume{.near_mm = kNearMm, .far_mm = kFarMm};
  RELIEVO_TRY_ASSIGN(const RectifiedPair pair, volume.rectify(small, reduced(calibration, reduction), inner));
  const Pyramids pyramids = build_pyramids(pair, kLevels, inner);
  Plane<float> disparity(&context.scratch, pair.width_px, pair.height_px, kNoDisparity);
  RELIEVO_TRY(match_down(whole_range(pair), pyramids, {kLevels - 1, 0, kBand, kCrossCheckPx},
                         SemiGlobalCosts{}, inner, 1, disparity));
  Relief relief(&context.output);
  fill_depth(pair, disparity, relief);
  label_surfaces(relief, context);
  if (context.stop()) return stopped();
  return relief;
}

}  // namespace relievo::pipeline
