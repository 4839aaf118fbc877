// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/channel_planes.h"

#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr int kBands = 16;
constexpr float kMiddleGrey = 128;

void fill_plane(const RectifiedView& view, int channel, int channels, ThreadPool& pool, Plane<float>& to) {
  pool.for_each_band(to.height, kBands, [&](int begin, int end, int) {
    const std::size_t first = static_cast<std::size_t>(begin) * static_cast<std::size_t>(to.width);
    const std::size_t last = static_cast<std::size_t>(end) * static_cast<std::size_t>(to.width);
    for (std::size_t k = first; k < last; ++k)
      to.values[k] =
          (channels == 1 ? view.grey[k]
                         : static_cast<float>(view.rgb[3 * k + static_cast<std::size_t>(channel)])) -
          kMiddleGrey;
  });
}

}  // namespace

DisparityRange disparity_range(const RectifiedPair& pair) {
  return {static_cast<int>(std::floor(pair.disparity_px(pair.far_mm))) - 1,
          static_cast<int>(std::ceil(pair.disparity_px(pair.near_mm))) + 1};
}

Plane<std::uint8_t> whole_windows(const RectifiedPair& pair, const RectifiedView& view, int radius,
                                  StageContext& context) {
  const int w = pair.width_px;
  const int h = pair.height_px;
  Plane<std::uint8_t> whole(&context.scratch, w, h);
  Arena::Mark mark(context.scratch);
  Plane<int> run(&context.scratch, w, 1);  // valid pixels above and on this row, without a gap
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x)
      run.values[static_cast<std::size_t>(x)] =
          view.valid[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) +
                     static_cast<std::size_t>(x)] != 0
              ? run.values[static_cast<std::size_t>(x)] + 1
              : 0;
    const int centre = y - radius;
    if (centre < radius) continue;
    int across = 0;
    for (int x = 0; x < w; ++x) {
      across = run.values[static_cast<std::size_t>(x)] >= 2 * radius + 1 ? across + 1 : 0;
      if (across >= 2 * radius + 1) whole.row(centre)[x - radius] = 1;
    }
  }
  return whole;
}

ChannelPlanes make_channel_planes(const RectifiedPair& pair, int channels, int radius,
                                  StageContext& context) {
  ChannelPlanes planes(&context.scratch, pair.width_px, pair.height_px);
  planes.radius = radius;
  planes.left.reserve(static_cast<std::size_t>(channels));
  planes.right.reserve(static_cast<std::size_t>(channels));
  for (int c = 0; c < channels; ++c) {
    planes.left.emplace_back(&context.scratch, pair.width_px, pair.height_px);
    fill_plane(pair.left, c, channels, context.pool, planes.left.back());
    planes.right.emplace_back(&context.scratch, pair.width_px, pair.height_px);
    fill_plane(pair.right, c, channels, context.pool, planes.right.back());
  }
  planes.whole_left = whole_windows(pair, pair.left, radius, context);
  planes.whole_right = whole_windows(pair, pair.right, radius, context);
  return planes;
}

}  // namespace relievo::pipeline
