// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/outline.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/lattice/cell_filler.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr float kSlopeRadiusMm = 1.5F;         // a cell's slope is the mean so far around it
constexpr float kGiven = 0.5F, kKept = 0.34F;  // of what lies around, so much must be in to gain a cell, or
                                               // to keep one: what was measured weighs more
constexpr float kAgreeMm = 1;  // along the line of sight, where it is steep: a third of it across the surface
constexpr float kRimMm = 6;    // a hole so near to the outside is a nick in the outline
constexpr float kChannelShare = 0.5F;  // of min_width_mm: narrower steep channels let nothing in

// Sums along rows over windows of 2 reach + 1, in place.
void sum_along_rows(std::pmr::vector<Vec3f>& v, int columns, int reach, std::pmr::memory_resource* memory) {
  std::pmr::vector<Vec3f> row(std::size_t(columns + 2 * reach), Vec3f{}, memory);
  const std::size_t w = std::size_t(columns);
  for (std::size_t first = 0; first < v.size(); first += w) {
    std::copy_n(v.begin() + std::ptrdiff_t(first), columns, row.begin() + reach);
    for (std::size_t c = 0; c < w; ++c) {
      Vec3f sum = row[c];
      for (std::size_t j = 1; j <= 2 * std::size_t(reach); ++j) sum = plus(sum, row[c + j]);
      v[first + c] = sum;
    }
  }
}

// What the outline gains by being straightened continues the surface within it. Where something was
// measured that continues it too, the measurement stays; the last rows before the horizon often do not.
void grow(PointLattice& l, const CellMask& before, const CellMask& wanted, float max_slope,
          MaskShaper& shaper, std::pmr::memory_resource* memory) {
  CellMask gained = before;
  shaper.erode(gained,
               1.5F * std::max(l.cell_width_mm, l.cell_height_mm));  // the steps along the old line too
  for (std::size_t k = 0; k < l.size(); ++k) {
    if (!before[k]) l.cells[k] = 0;
    gained[k] = wanted[k] && !gained[k] && triangle_count(l.cells[k]) < 2 &&
                l.inside(int(k) % l.columns + 1,
                         int(k) / l.columns + 1);  // the last column and row are no cells
  }
  const std::pmr::vector<Vec3f> at_mm(l.at_mm, memory);
  const std::pmr::vector<float> sigma_mm(l.sigma_mm, memory);
  const std::pmr::vector<Node> node(l.node, memory);
  fill_cells(l, gained, max_slope, {}, memory);
  for (std::size_t k = 0; k < l.size(); ++k) {
    if (l.node[k] == node[k] || node[k] == Node::Empty) continue;
    if (distance(l.at_mm[k], at_mm[k]) > kAgreeMm) continue;
    l.at_mm[k] = at_mm[k];
    l.sigma_mm[k] = sigma_mm[k];
    l.node[k] = node[k];
  }
  for (std::size_t k = 0; k < l.size(); ++k)
    if (gained[k]) l.cells[k] = best_cut(l, k, max_slope);
}

// See outline.h; `bow_mm` is the radius of the disc.
void round_off_nicks(const PointLattice& l, CellMask& kept, float bow_mm, MaskShaper& shaper,
                     std::pmr::memory_resource* memory) {
  CellMask near_outside(kept, memory);
  for (std::uint8_t& cell : near_outside) cell ^= 1;
  shaper.dilate(near_outside, kRimMm);
  for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = kept[k] && (l.cells[k] != 0 || !near_outside[k]);
  shaper.open(kept, bow_mm);
}

}  // namespace

CellMask steep_cells(const PointLattice& l, float max_slope, const Vec3f& from_mm,
                     std::pmr::memory_resource* memory) {
  std::pmr::vector<Vec3f> normal(l.size(), Vec3f{}, memory);
  for (std::size_t k = 0; k < l.size(); ++k) {
    if (triangle_count(l.cells[k]) != 2) continue;
    const Vec3f* p = &l.at_mm[k];
    const Vec3f* q = p + l.columns;
    normal[k] = cross(minus(q[0], p[1]), minus(q[1], p[0]));
  }
  sum_along_rows(normal, l.columns, int(kSlopeRadiusMm / l.cell_width_mm), memory);
  const int reach = int(kSlopeRadiusMm / l.cell_height_mm);
  const float cosine = cosine_of_slope(max_slope);
  CellMask steep(l.size(), 0, memory);
  for (int r = 0; r + 1 < l.rows; ++r)
    for (int c = 0; c + 1 < l.columns; ++c) {
      const std::size_t k = l.index(c, r);
      if (l.cells[k] == 0) continue;
      Vec3f n{};
      for (int y = std::max(r - reach, 0); y <= std::min(r + reach, l.rows - 1); ++y)
        n = plus(n, normal[l.index(c, y)]);
      const Vec3f p = minus(l.at_mm[l.node[k] != Node::Empty ? k : k + 1],
                            from_mm);  // a triangle holds one of the upper nodes
      const float towards = dot(n, p);
      steep[k] = towards * towards < cosine * cosine * dot(n, n) * dot(p, p);
    }
  return steep;
}

CellMask trim_outline(PointLattice& l, const OutlineLimits& limits, MaskShaper& shaper,
                      std::pmr::memory_resource* memory) {
  CellMask all(l.size(), 0, memory);
  for (std::size_t k = 0; k < l.size(); ++k) all[k] = l.cells[k] != 0;
  shaper.fill_holes(all);
  CellMask kept = all;
  const CellMask steep = steep_cells(l, limits.max_rim_slope, limits.from_mm, memory);
  for (std::size_t k = 0; k < l.size(); ++k) kept[k] = kept[k] && !steep[k];
  // A steep fold that leads from the outside to the nose must not open a way in.
  const float channel = kChannelShare * limits.min_width_mm;
  shaper.close(kept, channel, channel);
  shaper.fill_holes(kept);
  for (std::size_t k = 0; k < l.size(); ++k) kept[k] = kept[k] && all[k];
  shaper.open(kept, limits.min_width_mm / 2);
  if (limits.wave_mm > 0) {
    shaper.keep_largest_piece(kept);
    const CellMask before(kept, memory);
    CellMask given(kept, memory);
    shaper.straighten(given, limits.wave_mm, kGiven);
    shaper.straighten(kept, limits.wave_mm, kKept);
    for (std::size_t k = 0; k < l.size(); ++k) kept[k] = given[k] || (kept[k] && before[k]);
    grow(l, before, kept, limits.max_slope, shaper, memory);
    for (std::size_t k = 0; k < l.size(); ++k) kept[k] = kept[k] && (before[k] || l.cells[k]);
    round_off_nicks(l, kept, limits.min_width_mm, shaper, memory);
  }
  shaper.keep_largest_piece(kept);
  for (std::size_t k = 0; k < l.size(); ++k)
    if (!kept[k]) l.cells[k] = 0;
  return kept;
}

}  // namespace relievo::pipeline
