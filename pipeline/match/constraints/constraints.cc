// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/constraints/constraints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/base/statistics.h"
#include "pipeline/base/cells.h"
#include "pipeline/match/image/plane.h"
#include "pipeline/match/window/window_correlation.h"

namespace relievo::pipeline {
namespace {

struct Entry {
  int row;
  float left;
  float place;  // on the right row, with its slack
  std::uint32_t match;
};

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

}  // namespace

void SimilarityConstraint::judge(const RectifiedPair&, std::span<Match> matches, int, std::uint16_t bit,
                                 StageContext&) const {
  for (Match& match : matches)
    if (match.rejected_by == 0 && !(match.cost <= max_cost)) match.rejected_by = bit;
}

void UniquenessConstraint::judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px,
                                 std::uint16_t bit, StageContext& context) const {
  Arena::Mark mark(context.scratch);
  // One cell a lattice column of the right view: the largest disparity that landed there.
  const int cell = std::max(1, lattice_step_px);
  constexpr float kNothing = -1.0e9F;
  Plane<float> nearest(&context.scratch, pair.width_px / cell + 1, pair.height_px / cell + 1, kNothing);
  const auto place = [&](const Match& match) -> float* {
    const float x = (match.left_px.x - match.disparity_px) / float(cell);
    const int column = int(std::lround(x));
    const int row = int(std::lround(match.left_px.y / float(cell)));
    if (x < 0 || column >= nearest.width || row < 0 || row >= nearest.height) return nullptr;
    return nearest.row(row) + column;
  };
  for (const Match& match : matches)
    if (match.rejected_by == 0)
      if (float* at = place(match)) *at = std::max(*at, match.disparity_px);
  for (Match& match : matches) {
    if (match.rejected_by != 0) continue;
    const float* at = place(match);
    if (at == nullptr || *at - match.disparity_px > margin_px) match.rejected_by = bit;
  }
}

void ContinuityConstraint::judge(const RectifiedPair& pair, std::span<Match> matches, int lattice_step_px,
                                 std::uint16_t bit, StageContext& context) const {
  if (lattice_step_px <= 0) return;
  Arena::Mark mark(context.scratch);
  constexpr float kNothing = -1.0e9F;
  const int step = lattice_step_px;
  Plane<float> disparity(&context.scratch, pair.width_px / step + 3, pair.height_px / step + 3, kNothing);
  const auto cell = [&](const Match& match) {
    return disparity.row(int(match.left_px.y) / step + 1) + int(match.left_px.x) / step + 1;
  };
  for (const Match& match : matches)
    if (match.rejected_by == 0) *cell(match) = match.disparity_px;
  const float limit = max_step * float(step);
  for (Match& match : matches) {
    if (match.rejected_by != 0) continue;
    const float* here = cell(match);
    int support = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if ((i != 0 || j != 0) && std::abs(here[j * disparity.width + i] - match.disparity_px) <= limit)
          ++support;
    if (support < least_support) match.rejected_by = bit;
  }
}

void OrderingConstraint::judge(const RectifiedPair&, std::span<Match> matches, int, std::uint16_t bit,
                               StageContext& context) const {
  Arena::Mark mark(context.scratch);
  std::pmr::vector<Entry> entries(&context.scratch);
  entries.reserve(matches.size());
  for (std::uint32_t k = 0; k < matches.size(); ++k) {
    const Match& m = matches[k];
    if (m.rejected_by != 0 || !std::isfinite(m.disparity_px)) continue;
    entries.push_back(
        {int(std::lround(m.left_px.y)), m.left_px.x, m.left_px.x - m.disparity_px + slack * m.left_px.x, k});
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    if (a.row != b.row) return a.row < b.row;
    return a.left != b.left ? a.left < b.left : a.match < b.match;
  });
  std::pmr::vector<std::uint32_t> tails(&context.scratch), before(entries.size(), kNone, &context.scratch);
  std::pmr::vector<std::uint8_t> kept(entries.size(), std::uint8_t{0}, &context.scratch);
  tails.reserve(entries.size());
  const auto falls = [&](std::uint32_t a, std::uint32_t b) { return entries[a].place < entries[b].place; };
  for (std::uint32_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    if (context.stop()) return;
    // The largest subset of a row's entries whose places do not fall is kept. tails[n]: the end of the
    // ordered set of n + 1 whose last place is least.
    tails.clear();
    for (; end < entries.size() && entries[end].row == entries[begin].row; ++end) {
      const auto at = std::ranges::upper_bound(tails, end, falls);
      if (at != tails.begin()) before[end] = *(at - 1);
      if (at == tails.end()) tails.push_back(end);
      else *at = end;
    }
    for (std::uint32_t k = tails.back(); k != kNone; k = before[k]) kept[k] = 1;
  }
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (kept[k] == 0) matches[entries[k].match].rejected_by = bit;
}

namespace {

constexpr int kAskedBands = 32;

// False of a match that cannot be asked. `scores` has the views exchanged: its left view is the pair's right
// one, and disparities change sign.
bool found_elsewhere(const Match& match, const LeftRightConstraint& options, PatchScores& scores) {
  const float right = match.left_px.x - match.disparity_px;
  const int middle = int(std::lround(match.disparity_px));
  const int count = 2 * options.search_px + 1;
  // Candidate k lies at right + middle + search_px - k on the left row.
  if (!scores.load({right, match.left_px.y}, -(middle + options.search_px), count)) return false;
  if (!std::isfinite(scores.score(options.search_px).unlike)) return false;
  int best = 0;
  double least = scores.score(0).unlike;
  for (int k = 1; k < count; ++k)
    if (const double here = scores.score(k).unlike; here < least) {
      least = here;
      best = k;
    }
  if (best == 0 || best == count - 1) return true;
  const double before = scores.score(best - 1).unlike;
  const double after = scores.score(best + 1).unlike;
  const double bend = before - 2 * least + after;
  const double offset = std::isfinite(bend) && bend > 0 ? (before - after) / (2 * bend) : 0;
  const double found = double(right) + middle + options.search_px - best - offset;
  return !(std::abs(found - double(match.left_px.x)) <= double(options.limit_px));
}

}  // namespace

void LeftRightConstraint::judge(const RectifiedPair& pair, std::span<Match> matches, int, std::uint16_t bit,
                                StageContext& context) const {
  if (matches.empty() || pair.left.grey.empty() || pair.right.grey.empty()) return;
  Arena::Mark mark(context.scratch);
  ChannelPlanes planes = make_channel_planes(pair, 1, window_px / 2, context);
  std::swap(planes.left, planes.right);
  std::swap(planes.whole_left, planes.whole_right);
  std::pmr::vector<PatchScores> scores(&context.scratch);
  scores.reserve(kAskedBands);
  for (int band = 0; band < kAskedBands; ++band)
    scores.emplace_back(planes, WindowScore::ZeroMeanCorrelation, 2 * search_px + 1, &context.scratch);
  context.pool.for_each<std::size_t>(int(matches.size()), kAskedBands, [&](std::size_t k, int band) {
    Match& match = matches[k];
    if (context.stop() || match.rejected_by != 0 || !(std::abs(match.disparity_px) < 1e6F)) return;
    if (found_elsewhere(match, *this, scores[std::size_t(band)])) match.rejected_by = bit;
  });
}

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
  context.pool.for_each<std::uint32_t>(int(matches.size()), kBands, [&](std::uint32_t k) {
    if (context.stop() || matches[k].rejected_by != 0) return;
    const float limit = global_sigmas * std::max(whole.sigma, floor_px);
    const bool far = global_sigmas > 0 && std::abs(matches[k].disparity_px - whole.median) > limit;
    out[k] = far || (local_sigmas > 0 && stands_out(k, matches, cells, *this)) ? 1 : 0;
  });
  for (std::size_t k = 0; k < matches.size(); ++k)
    if (out[k] != 0) matches[k].rejected_by = bit;
}

}  // namespace relievo::pipeline
