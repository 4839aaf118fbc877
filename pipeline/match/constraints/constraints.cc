// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/constraints/constraints.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {
namespace {

struct Entry {
  int row;
  float left;
  float place;  // on the right row, with its slack
  std::uint32_t match;
};

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// Marks the largest subset of a row's entries (sorted by `left`) whose places do not fall.
class RowJudge {
 public:
  RowJudge(std::size_t most, std::pmr::memory_resource* memory)
      : tails_(memory), before_(memory), kept_(memory) {
    tails_.reserve(most);
    before_.reserve(most);
    kept_.reserve(most);
  }

  const std::pmr::vector<std::uint8_t>& keep(std::span<const Entry> row) {
    tails_.clear();
    before_.assign(row.size(), kNone);
    kept_.assign(row.size(), std::uint8_t{0});
    for (std::uint32_t k = 0; k < row.size(); ++k) {
      // tails_[n]: the end of the ordered set of n + 1 whose last place is least.
      const auto at =
          std::upper_bound(tails_.begin(), tails_.end(), k,
                           [&](std::uint32_t a, std::uint32_t b) { return row[a].place < row[b].place; });
      before_[k] = at == tails_.begin() ? kNone : *(at - 1);
      if (at == tails_.end()) tails_.push_back(k);
      else *at = k;
    }
    for (std::uint32_t k = tails_.empty() ? kNone : tails_.back(); k != kNone; k = before_[k]) kept_[k] = 1;
    return kept_;
  }

 private:
  std::pmr::vector<std::uint32_t> tails_, before_;
  std::pmr::vector<std::uint8_t> kept_;
};

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
  RowJudge judge(entries.size(), &context.scratch);
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    if (context.stop()) return;
    while (end < entries.size() && entries[end].row == entries[begin].row) ++end;
    const auto& kept = judge.keep(std::span<const Entry>(entries).subspan(begin, end - begin));
    for (std::size_t k = begin; k < end; ++k)
      if (kept[k - begin] == 0) matches[entries[k].match].rejected_by = bit;
  }
}

}  // namespace relievo::pipeline
