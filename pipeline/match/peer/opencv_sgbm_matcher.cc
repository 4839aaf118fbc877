// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>

#include "pipeline/match/peer/sgbm_matcher.h"
#include "pipeline/match/window/window_correlation.h"
#include "pipeline/model/photo_sampler.h"

namespace relievo::pipeline {
namespace {

constexpr double kMostBytes = 2.0 * (1 << 30);  // aloe with 256 disparities needs 1.4

// The part of both pictures that the keypoints need.
struct Crop {
  int x0, y0, width, height;
};

Crop crop_for(const RectifiedPair& pair, const Keypoints& keypoints, int first, int count) {
  float left = float(pair.width_px);
  float right = 0;
  float top = float(pair.height_px);
  float bottom = 0;
  for (const Keypoint& k : keypoints.points) {
    left = std::min(left, k.at_px.x);
    right = std::max(right, k.at_px.x);
    top = std::min(top, k.at_px.y);
    bottom = std::max(bottom, k.at_px.y);
  }
  constexpr int kMargin = 32;
  const int x0 = std::max(0, int(left) - kMargin - std::max(0, first + count));
  const int x1 = std::min(pair.width_px, int(right) + kMargin - std::min(0, first));
  const int y0 = std::max(0, int(top) - kMargin);
  const int y1 = std::min(pair.height_px, int(bottom) + kMargin);
  return {x0, y0, x1 - x0, y1 - y0};
}

cv::Mat grey_of(const RectifiedPair& pair, const RectifiedView& view, const Crop& crop,
                std::pmr::vector<std::uint8_t>& bytes) {
  bytes.resize(std::size_t(crop.width) * std::size_t(crop.height));
  for (int y = 0; y < crop.height; ++y)
    for (int x = 0; x < crop.width; ++x)
      bytes[std::size_t(y) * std::size_t(crop.width) + std::size_t(x)] =
          to_byte(view.grey[pair.index(crop.x0 + x, crop.y0 + y)]);
  return {crop.height, crop.width, CV_8UC1, bytes.data()};
}

cv::Mat compute(const RectifiedPair& pair, const SgbmMatcher& options, const Crop& crop, int first, int count,
                StageContext& context) {
  std::pmr::vector<std::uint8_t> left(&context.scratch);
  std::pmr::vector<std::uint8_t> right(&context.scratch);
  const int area = options.window_px * options.window_px;
  const auto sgbm = cv::StereoSGBM::create(
      first, count, options.window_px, 8 * area, 32 * area, options.max_lr_px, 63, options.uniqueness,
      options.speckle_px, 2,
      options.mode == SgbmMode::ThreeWay ? cv::StereoSGBM::MODE_SGBM_3WAY : cv::StereoSGBM::MODE_HH);
  cv::Mat disparity;
  sgbm->compute(grey_of(pair, pair.left, crop, left), grey_of(pair, pair.right, crop, right), disparity);
  return disparity;
}

}  // namespace

Result<MatchSet> SgbmMatcher::match(const RectifiedPair& pair, const Keypoints& keypoints,
                                    StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  if (keypoints.points.empty()) return nothing_matches();
  const int first = int(std::floor(pair.disparity_px(pair.far_mm)));
  const int needed = int(std::ceil(pair.disparity_px(pair.near_mm))) + 1 - first;
  const int count = (needed + 15) / 16 * 16;
  const Crop crop = crop_for(pair, keypoints, first, count);
  if (crop.width <= count + window_px || crop.height <= window_px)
    return invalid(
        "the pictures are narrower than the volume's disparities: narrow the volume (--near, --far)");
  // Its own volumes: two of 16 bits.
  const double bytes = 4.0 * crop.width * crop.height * count;
  if (mode == SgbmMode::HH && bytes > kMostBytes)
    return Error{
        Errc::OutOfMemory,
        "opencv-sgbm: hh would need more than 2 GiB here: choose 3way or narrow the volume (--near, --far)"};
  if (context.stop()) return stopped();
  DisparityField field{{&context.scratch, crop.width, crop.height, kNoDisparity},
                       {float(crop.x0), float(crop.y0)}};
  const cv::Mat disparity = compute(pair, *this, crop, first, count, context);
  for (int y = 0; y < crop.height; ++y)
    for (int x = 0; x < crop.width; ++x)
      if (const int value = disparity.at<std::int16_t>(y, x); value >= 16 * first)
        field.values.row(y)[x] = float(value) / 16;
  return matches_in_field(field, pair, keypoints, context);
}

}  // namespace relievo::pipeline
