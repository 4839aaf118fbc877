// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/constraints/constraints.h"

#include <algorithm>
#include <cmath>

#include "hal/base/statistics.h"
#include "pipeline/base/cells.h"

namespace relievo::pipeline {
namespace {

constexpr int kBands = 32;
constexpr int kFewest = 5;
constexpr int kMostNeighbours = 256;  // of more, every second, third, ... votes
constexpr float kMadToSigma = 1.4826F;

struct Spread {
  float median;
  float sigma;
};

// Changes the order of the values.
Spread spread_of(std::span<float> values) {
  const auto middle = float(median(values));
  for (float& v : values) v = std::abs(v - middle);
  return {middle, kMadToSigma * float(median(values))};
}

int cell_of(float at_px, float radius) { return std::max(0, int(at_px / radius)); }

// Accepted matches in square cells of one radius.
Cells cells_of(std::span<const Match> matches, float radius, std::pmr::memory_resource* memory) {
  float right = 0;
  float bottom = 0;
  for (const Match& m : matches) {
    if (m.rejected_by != 0) continue;
    right = std::max(right, m.left_px.x);
    bottom = std::max(bottom, m.left_px.y);
  }
  Cells cells(memory);
  cells.fill(cell_of(right, radius) + 1, cell_of(bottom, radius) + 1, [&](auto&& add) {
    for (std::uint32_t k = 0; k < matches.size(); ++k)
      if (const Match& m = matches[k]; m.rejected_by == 0)
        add(cell_of(m.left_px.x, radius), cell_of(m.left_px.y, radius), k);
  });
  return cells;
}

bool stands_out(std::uint32_t k, std::span<const Match> matches, const Cells& cells,
                const StatisticalConstraint& options) {
  const Match& m = matches[k];
  const int c = cell_of(m.left_px.x, options.radius_px);
  const int r = cell_of(m.left_px.y, options.radius_px);
  std::size_t around = 0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) around += cells.at(c + i, r + j).size();
  const std::size_t stride = around / kMostNeighbours + 1;
  float near[kMostNeighbours];
  std::size_t n = 0;
  std::size_t turn = 0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      for (const std::uint32_t other : cells.at(c + i, r + j)) {
        if (turn++ % stride != 0 || other == k || n == kMostNeighbours) continue;
        const Match& q = matches[other];
        if (std::abs(q.left_px.x - m.left_px.x) <= options.radius_px &&
            std::abs(q.left_px.y - m.left_px.y) <= options.radius_px)
          near[n++] = q.disparity_px;
      }
  if (n < kFewest) return false;
  const Spread spread = spread_of({near, n});
  return std::abs(m.disparity_px - spread.median) >
         options.local_sigmas * std::max(spread.sigma, options.floor_px);
}

}  // namespace

void StatisticalConstraint::judge(const RectifiedPair&, std::span<Match> matches, int, std::uint16_t bit,
                                  StageContext& context) const {
  Arena::Mark mark(context.scratch);
  std::pmr::vector<float> all(&context.scratch);
  all.reserve(matches.size());
  for (const Match& m : matches)
    if (m.rejected_by == 0) all.push_back(m.disparity_px);
  if (all.size() < kFewest) return;
  const Spread whole = spread_of(all);
  std::pmr::vector<std::uint8_t> out(matches.size(), std::uint8_t{0}, &context.scratch);
  const Cells cells = cells_of(matches, radius_px, &context.scratch);
  context.pool.for_each_band(int(matches.size()), kBands, [&](int begin, int end, int) {
    for (auto k = std::uint32_t(begin); k < std::uint32_t(end) && !context.stop(); ++k) {
      if (matches[k].rejected_by != 0) continue;
      const float limit = global_sigmas * std::max(whole.sigma, floor_px);
      const bool far = global_sigmas > 0 && std::abs(matches[k].disparity_px - whole.median) > limit;
      out[k] = far || (local_sigmas > 0 && stands_out(k, matches, cells, *this)) ? 1 : 0;
    }
  });
  for (std::size_t k = 0; k < matches.size(); ++k)
    if (out[k] != 0) matches[k].rejected_by = bit;
}

}  // namespace relievo::pipeline
