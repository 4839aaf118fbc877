// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/image/plane_filters.h"

#include <algorithm>

namespace relievo::pipeline {
namespace {

float across(const float* row, int x, int width) {
  const auto at = [&](int k) { return row[std::clamp(k, 0, width - 1)]; };
  return at(x - 2) + 4 * at(x - 1) + 6 * at(x) + 4 * at(x + 1) + at(x + 2);
}

}  // namespace

Pyramids build_pyramids(const RectifiedPair& pair, int count, StageContext& context) {
  const auto build = [&](const RectifiedView& view) {
    std::pmr::vector<PyramidLevel> levels(&context.scratch);
    levels.reserve(std::size_t(count));
    levels.emplace_back(&context.scratch, pair.width_px, pair.height_px);
    std::ranges::copy(view.grey, levels[0].grey.values.begin());
    std::ranges::copy(view.valid, levels[0].valid.values.begin());
    for (int level = 1; level < count; ++level)
      levels.emplace_back(&context.scratch, (levels.back().grey.width + 1) / 2,
                          (levels.back().grey.height + 1) / 2);
    halve_levels(levels, context.pool);
    return levels;
  };
  return {build(pair.left), build(pair.right)};
}

void halve_row(const PyramidLevel& whole, PyramidLevel& half, int j) {
  const int width = whole.grey.width, height = whole.grey.height;
  constexpr float kWeight[5] = {1, 4, 6, 4, 1};
  float* to = half.grey.row(j);
  std::fill(to, to + half.grey.width, 0.0F);
  for (int k = -2; k <= 2; ++k) {
    const float* from = whole.grey.row(std::clamp(2 * j + k, 0, height - 1));
    const float w = kWeight[k + 2] * (1.0F / 256);
    const int inner_end = std::min(half.grey.width, (width - 2) / 2);
    for (int i = 0; i < std::min(1, half.grey.width); ++i) to[i] += w * across(from, 2 * i, width);
    for (int i = 1; i < inner_end; ++i) {
      const float* p = from + 2 * i;
      to[i] += w * (p[-2] + 4 * p[-1] + 6 * p[0] + 4 * p[1] + p[2]);
    }
    for (int i = std::max(1, inner_end); i < half.grey.width; ++i) to[i] += w * across(from, 2 * i, width);
  }
  const std::uint8_t* from = whole.valid.row(std::min(2 * j, height - 1));
  std::uint8_t* flag = half.valid.row(j);
  for (int i = 0; i < half.grey.width; ++i) flag[i] = from[std::min(2 * i, width - 1)];
}

void halve_levels(std::pmr::vector<PyramidLevel>& levels, ThreadPool& pool) {
  constexpr int kPyramidBands = 8;
  for (std::size_t level = 1; level < levels.size(); ++level) {
    PyramidLevel& to = levels[level];
    pool.for_each(to.grey.height, kPyramidBands, [&](int j) { halve_row(levels[level - 1], to, j); });
  }
}

}  // namespace relievo::pipeline
