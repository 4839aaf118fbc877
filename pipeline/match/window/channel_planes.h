// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// ChannelPlanes: the grey values or the three colours of both views as planes of numbers, centred on
// middle grey (sums of products then lose fewer digits), and where a window is wholly inside its picture.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct ChannelPlanes {
  ChannelPlanes(std::pmr::memory_resource* memory, int width, int height)
      : left(memory), right(memory), whole_left(memory, width, height), whole_right(memory, width, height) {}
  std::pmr::vector<Plane<float>> left;  // 1 or 3; grey levels minus 128
  std::pmr::vector<Plane<float>> right;
  Plane<std::uint8_t> whole_left;  // 1 where every pixel of the window about this one is valid
  Plane<std::uint8_t> whole_right;
  int radius = 0;
};

// Inclusive; whole pixels. One candidate beyond the volume on both sides, so that its ends have neighbours.
struct DisparityRange {
  int first = 0;
  int last = 0;
  int count() const { return last - first + 1; }
};
DisparityRange disparity_range(const RectifiedPair& pair);

// 1 where the square of 2 radius + 1 pixels about a pixel lies inside the picture and is valid throughout.
Plane<std::uint8_t> whole_windows(const RectifiedPair& pair, const RectifiedView& view, int radius,
                                  StageContext& context);

// `channels` is 1 (grey) or 3 (colours). On context.scratch.
ChannelPlanes make_channel_planes(const RectifiedPair& pair, int channels, int radius, StageContext& context);

}  // namespace relievo::pipeline
