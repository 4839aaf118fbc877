// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/texture/texture_sharpness.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace relievo::pipeline {
namespace {

// The paper blurs with a mean of nine; two neighbours' means differ by a ninth of what entered and left.
constexpr int kMean = 9;
constexpr int kAhead = kMean / 2;
constexpr int kBehind = kAhead + 1;

struct Variation {
  double all = 0, lost = 0;
};  // of neighbours, and how much of it one more blur takes

// `step`: from one texel to the next along the direction looked in.
void add_line(const std::uint8_t* luminance, const std::uint8_t* origin, std::size_t step, int count,
              Variation& sum) {
  int run = 0;
  for (int i = 0; i < count; ++i) {
    run = origin[std::size_t(i) * step] >= kLeftPhotographTexel ? run + 1 : 0;
    if (run < kAhead + kBehind + 1) continue;
    const auto at = [&](int back) { return int(luminance[std::size_t(i - back) * step]); };
    const int own = kMean * std::abs(at(kAhead) - at(kAhead + 1));
    const int blurred = std::abs(at(0) - at(kMean));
    sum.all += own;
    sum.lost += std::max(0, own - blurred);
  }
}

}  // namespace

double texture_sharpness(const TextureAtlas& atlas, StageContext& context) {
  Arena::Mark mark(context.scratch);
  const std::size_t w = std::size_t(atlas.width_px);
  std::pmr::vector<std::uint8_t> luminance(atlas.origin.size(), 0, &context.scratch);
  for (std::size_t k = 0; k < luminance.size(); ++k)
    luminance[k] =
        std::uint8_t((77 * atlas.rgb[3 * k] + 150 * atlas.rgb[3 * k + 1] + 29 * atlas.rgb[3 * k + 2]) >> 8);
  Variation across;
  Variation down;
  for (int y = 0; y < atlas.height_px; ++y) {
    const std::size_t row = std::size_t(y) * w;
    add_line(&luminance[row], &atlas.origin[row], 1, atlas.width_px, across);
  }
  for (std::size_t x = 0; x < w; ++x) add_line(&luminance[x], &atlas.origin[x], w, atlas.height_px, down);
  // The more blurred of the two directions is what is seen.
  const auto share = [](const Variation& v) { return v.all > 0 ? v.lost / v.all : 0.0; };
  return std::min(share(across), share(down));
}

}  // namespace relievo::pipeline
