// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/image/pyramids.h"

#include <algorithm>

namespace relievo::pipeline {

Pyramids build_pyramids(const RectifiedPair& pair, int count, StageContext& context) {
  Pyramids pyramids{std::pmr::vector<PyramidLevel>(&context.scratch),
                    std::pmr::vector<PyramidLevel>(&context.scratch)};
  for (int side = 0; side < 2; ++side) {
    auto& levels = side == 0 ? pyramids.left : pyramids.right;
    const RectifiedView& view = side == 0 ? pair.left : pair.right;
    levels.reserve(static_cast<std::size_t>(count));
    levels.emplace_back(&context.scratch, pair.width_px, pair.height_px);
    std::copy(view.grey.begin(), view.grey.end(), levels[0].grey.values.begin());
    std::copy(view.valid.begin(), view.valid.end(), levels[0].valid.values.begin());
    for (int level = 1; level < count; ++level)
      levels.emplace_back(&context.scratch, (levels.back().grey.width + 1) / 2,
                          (levels.back().grey.height + 1) / 2);
    halve_levels(levels, context.pool);
  }
  return pyramids;
}

}  // namespace relievo::pipeline
