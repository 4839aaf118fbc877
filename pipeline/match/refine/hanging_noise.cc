// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/hanging_noise.h"

#include <algorithm>
#include <array>

namespace relievo::pipeline {
namespace {

constexpr float kLoud =
    12;  // grey levels: what disagrees by more is no noise, and a few such pixels would drown it
constexpr int kFurthest = 2;  // shift in pixels over which hanging noise is looked for

// Mean products of the residuals, and of the gradients, with themselves some pixels further; 0 where none
// meet.
struct Alike {
  double residual = 0, gradient = 0;
};

Alike likeness(const WarpTerms& terms, int dx, int dy) {
  constexpr int kEvery = 3;  // rows looked at
  const int w = terms.residual.width;
  Alike sum;
  double count = 0;
  const auto calm = [](float v) { return static_cast<double>(std::clamp(v, -kLoud, kLoud)); };
  for (int y = 0; y + dy < terms.residual.height; y += kEvery) {
    const float* in = terms.mask.row(y);
    const float* in_too = terms.mask.row(y + dy) + dx;
    const float *r = terms.residual.row(y), *r_too = terms.residual.row(y + dy) + dx;
    const float *g = terms.gradient.row(y), *g_too = terms.gradient.row(y + dy) + dx;
    for (int x = kFurthest; x < w - kFurthest; ++x) {
      if (in[x] == 0 || in_too[x] == 0) continue;
      sum.residual += calm(r[x]) * calm(r_too[x]);
      sum.gradient += calm(g[x]) * calm(g_too[x]);
      count += 1;
    }
  }
  return count > 0 ? Alike{sum.residual / count, sum.gradient / count} : Alike{};
}

}  // namespace

float hanging_noise(const WarpTerms& terms, ThreadPool& pool) {
  constexpr float kWhite =
      1.6F;  // the sum for pictures with white noise: warping and the skin's own detail make so much of it
  constexpr float kMost = 6;
  // A shift and its opposite say the same: half of them, after none at all.
  constexpr int kShifts = kFurthest * (2 * kFurthest + 2) + 1;
  std::array<Alike, kShifts> alike;
  pool.for_each_band(kShifts, kShifts, [&](int, int, int k) {
    const int side = 2 * kFurthest + 1;
    const int dy = (k + kFurthest) / side;
    alike[static_cast<std::size_t>(k)] = likeness(terms, (k + kFurthest) % side - kFurthest, dy);
  });
  const Alike& same = alike[0];
  if (!(same.residual > 0 && same.gradient > 0)) return 1;
  double sum = 1;
  for (std::size_t k = 1; k < alike.size(); ++k)
    sum += 2 * (alike[k].residual / same.residual) * (alike[k].gradient / same.gradient);
  return std::clamp(static_cast<float>(sum) / kWhite, 1.0F, kMost);
}

}  // namespace relievo::pipeline
