// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/rectify/given_pair.h"

#include <algorithm>

#include "pipeline/match/rectify/rectifier.h"

namespace relievo::pipeline {
namespace {

constexpr double kBaselineMm = 110;  // of the recommended rig; the focal length is the picture's width

void take_view(const ImageView& image, RectifiedView& view, StageContext& context) {
  const std::size_t pixels = std::size_t(image.width_px) * std::size_t(image.height_px);
  view.grey.resize(pixels);
  view.rgb.resize(3 * pixels);
  view.valid.assign(pixels, 1);
  context.pool.for_each_band(image.height_px, 16, [&](int begin, int end, int) {
    grey_rows(image, view.grey.data(), image.width_px, begin, end);
    for (int y = begin; y < end; ++y) {
      std::uint8_t* to = view.rgb.data() + 3 * std::ptrdiff_t(y) * image.width_px;
      const float* grey = view.grey.data() + std::ptrdiff_t(y) * image.width_px;
      if (image.format == PixelFormat::Rgb8) std::copy_n(image.row(y), 3 * image.width_px, to);
      else
        for (int x = 0; x < image.width_px; ++x) std::fill_n(to + 3 * x, 3, std::uint8_t(grey[x]));
    }
  });
}

}  // namespace

Result<void> DisparityRange::check() const {
  if (least_px >= -4096 && most_px <= 4096 && least_px < most_px) return {};
  return Error{Errc::InvalidInput,
               "disparities: two whole numbers of pixels are wanted, the smaller first, within 4096"};
}

Result<RectifiedPair> take_rectified(const StereoFrame& frame, const DisparityRange& range,
                                     StageContext& context) {
  RELIEVO_TRY(range.check());
  if (frame.left.empty() || frame.right.empty()) return Error{Errc::InvalidInput, "the picture is empty"};
  if (frame.left.width_px != frame.right.width_px || frame.left.height_px != frame.right.height_px)
    return Error{Errc::InvalidInput, "the two pictures of a rectified pair differ in size"};
  RectifiedPair pair(&context.output);
  pair.width_px = frame.left.width_px;
  pair.height_px = frame.left.height_px;
  pair.focal_px = pair.width_px;
  pair.baseline_mm = kBaselineMm;
  // Infinity lies below the least disparity, so that every depth is a number.
  const double infinity = std::min(0, range.least_px - 1);
  pair.left_centre_px = {0.5 * (pair.width_px - 1), 0.5 * (pair.height_px - 1)};
  pair.right_centre_px = {pair.left_centre_px.x - infinity, pair.left_centre_px.y};
  pair.near_mm = pair.depth_mm(range.most_px);
  pair.far_mm = pair.depth_mm(range.least_px);
  pair.right_from_left.translation_mm = {-kBaselineMm, 0, 0};
  take_view(frame.left, pair.left, context);
  if (context.stop()) return Error{Errc::Cancelled, "stopped while taking the pictures"};
  take_view(frame.right, pair.right, context);
  return pair;
}

}  // namespace relievo::pipeline
