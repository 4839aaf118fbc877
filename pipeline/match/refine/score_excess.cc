// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/refine/score_excess.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/image/box_filter.h"

namespace relievo::pipeline {
namespace {

constexpr int kBlockRadius = 3;  // nodes: about the reach of the fit on skin
constexpr int kBlock = 2 * kBlockRadius + 1;
constexpr int kMeanRadius = 6;  // over which the blocks' variance is taken

// What independent residuals leave of their own variance in the sum of a block, after the fit: it answers
// to waves longer than 1 / reach, reach = (data / bending)^(1/4) a node. The ratio of the integrals of
// B^2 H^2 and B^2, B the block's and H = L / (reach^4 + L) the remainder's transfer function, L that of
// the squared second differences; within 3 % from 0.1 to 0.8.
float left_by_the_fit(float reach) { return 1 / (1 + std::pow(3.05F * reach, 1.95F)); }

constexpr float kLeastExcess = 0.5F;  // calmer by more is chance. Cut off at 1, the mean would be too large.

// Tents overlap by half: a block of them counts the pixels along its edges in part.
float tent_share(int step) {
  const float along = step == 1 ? 1.0F : (2.0F * kBlock - 0.5F) / (2.0F * kBlock);
  return along * along;
}

}  // namespace

void measure_score_excess(const BendingSystem& system, const Plane<float>& pull, const Plane<float>& real,
                          int step, ThreadPool& pool, std::pmr::memory_resource& scratch,
                          Plane<float>& excess) {
  const int w = system.width();
  const int h = system.height();
  Plane<float> across(&scratch, w, h), told(&scratch, w, h), answers(&scratch, w, h), bend(&scratch, w, h);
  box_sum(pull, kBlockRadius, pool, across, excess);
  for (float& v : excess.values) v *= v;
  box_sum(excess, kMeanRadius, pool, across, excess);
  box_sum(system.data, kBlockRadius, pool, across, told);
  box_sum(told, kMeanRadius, pool, across, told);
  box_sum(real, kBlockRadius, pool, across, answers);
  box_sum(answers, kMeanRadius, pool, across, answers);
  box_sum(system.bend_xx, kMeanRadius, pool, across, bend);
  constexpr float kCells = kBlock * kBlock;
  const float share = tent_share(step);
  for (std::size_t k = 0; k < excess.values.size(); ++k) {
    if (!(told.values[k] > 0 && bend.values[k] > 0)) {
      excess.values[k] = 1;
      continue;
    }
    const float reach = std::sqrt(
        std::sqrt(std::max(answers.values[k], kLeastReal * told.values[k]) / kCells / bend.values[k]));
    const float expected = told.values[k] * share * left_by_the_fit(reach);
    excess.values[k] = std::max(kLeastExcess, excess.values[k] / expected);
  }
}

}  // namespace relievo::pipeline
