// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include <cmath>

#include "tests/bench/peer.h"

namespace relievo::bench {

long match_like_the_peer(const pipeline::RectifiedPair& pair) {
  const auto wrap = [&](const pipeline::RectifiedView& view) {
    return cv::Mat(pair.height_px, pair.width_px, CV_8UC3, const_cast<std::uint8_t*>(view.rgb.data()));
  };
  const int least = static_cast<int>(std::floor(pair.disparity_px(pair.far_mm)));
  const int most = static_cast<int>(std::ceil(pair.disparity_px(pair.near_mm)));
  constexpr int kBlock = 5;
  const auto peer =
      cv::StereoSGBM::create(least, (most - least + 15) / 16 * 16, kBlock, 8 * 3 * kBlock * kBlock,
                             32 * 3 * kBlock * kBlock, 1, 31, 8, 200, 2, cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat disparity;
  peer->compute(wrap(pair.left), wrap(pair.right), disparity);
  return cv::countNonZero(disparity >= 16 * least);
}

}  // namespace relievo::bench
