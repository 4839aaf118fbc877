// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/surface_shaping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

struct Cell {
  int c, r;
};

constexpr float kSpeckMm2 = 4;
constexpr float kPinholeRimMm = 1.2F;
constexpr std::uint8_t kOpen = 0, kBridged = 1, kUndecided = 2;

class GapCloser {
 public:
  GapCloser(PointLattice& lattice, const LatticeLimits& limits, MaskShaper& shaper,
            std::pmr::memory_resource* memory)
      : lattice_(lattice), limits_(limits), shaper_(shaper), memory_(memory) {}

  void close() {
    drop_specks();
    find_gaps();
    for (int r = 0; r + 1 < lattice_.rows; ++r)
      for (int c = 0; c + 1 < lattice_.columns; ++c)
        if (std::uint8_t& gap = gap_[lattice_.index(c, r)]) gap = bridge({c, r});
    settle_crossings();
    fill_cells(lattice_, gap_, limits_.max_slope, {}, memory_);
    mend_pinholes();
  }

 private:
  // A speck between two cracks bridges nothing and would only hold a lid down where an outlier lies.
  void drop_specks() {
    for (std::size_t k = 0; k < whole_.size(); ++k) whole_[k] = triangle_count(lattice_.cells[k]) == 2;
    const float radius = limits_.max_gap_mm / 2;
    shaper_.drop_pieces_below(whole_, std::size_t(std::numbers::pi_v<float> * radius * radius / cell_mm2_));
    gap_ = whole_;
    shaper_.dilate(gap_, 1.5F * std::max(lattice_.cell_width_mm, lattice_.cell_height_mm));
    for (std::size_t k = 0; k < gap_.size(); ++k)
      if (!gap_[k]) lattice_.cells[k] = 0;
  }

  // What a bridge leaves open where noise makes it too steep: what lies around is laid anew.
  void mend_pinholes() {
    for (std::size_t k = 0; k < whole_.size(); ++k) whole_[k] = triangle_count(lattice_.cells[k]) == 2;
    gap_ = whole_;
    shaper_.fill_holes(gap_);
    for (std::size_t k = 0; k < whole_.size(); ++k) gap_[k] = large_[k] = gap_[k] && !whole_[k];
    shaper_.drop_pieces_below(large_, std::size_t(kSpeckMm2 / cell_mm2_));
    for (std::size_t k = 0; k < whole_.size(); ++k) gap_[k] = gap_[k] && !large_[k];
    shaper_.dilate(gap_, kPinholeRimMm);
    for (std::size_t k = 0; k < whole_.size(); ++k) {
      gap_[k] = gap_[k] && !large_[k] && lattice_.is_cell(k);
      if (gap_[k]) lattice_.cells[k] = 0;
    }
    fill_cells(lattice_, gap_, limits_.max_slope, {}, memory_);
  }

  // Where a disc of the widest gap's size does not fit. The way back is a little longer than the way
  // out: the steps of a lattice along a slanted outline are no gaps.
  void find_gaps() {
    const float radius = (limits_.max_gap_mm + cell_mm_) / 2;
    gap_ = whole_;
    shaper_.close(gap_, radius, radius + 0.75F * cell_mm_);
    for (std::size_t k = 0; k < gap_.size(); ++k)
      gap_[k] = was_gap_[k] = gap_[k] && !whole_[k] ? kUndecided : kOpen;
  }

  // Whether the shortest way across the gap continues the surface on its two sides. Undecided where no
  // way is short enough, as where two cracks cross.
  std::uint8_t bridge(Cell at) const {
    constexpr Cell kWays[] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    float narrowest = limits_.max_gap_mm;
    std::uint8_t verdict = kUndecided;
    for (const Cell& way : kWays) {
      const std::optional<Cell> from = rim(at, {-way.c, -way.r});
      if (!from) continue;
      const std::optional<Cell> to = rim(at, way);
      if (!to) continue;
      const ViewEdge edge = edge_between(middle(*from), middle(*to));
      const float cells = float(std::max(std::abs(to->c - from->c), std::abs(to->r - from->r)));
      const float width = std::hypot(edge.depth_mm, edge.across_mm) * (cells - 1) / cells;
      if (width > narrowest) continue;
      narrowest = width;
      const float before = -slope_behind(*from, {-way.c, -way.r}), after = slope_behind(*to, way);
      const float most = std::max(before, after) * edge.across_mm;
      const float least = std::min(before, after) * edge.across_mm;
      const float allowed = limits_.min_step_mm + limits_.max_bend * width;
      const bool continues = edge.depth_mm <= most + allowed && edge.depth_mm >= least - allowed;
      verdict = continues ? kBridged : kOpen;
    }
    return verdict;
  }

  // What is undecided joins the bridges around it; where it touches anything open, it stays open.
  void settle_crossings() {
    std::pmr::vector<std::uint32_t> opened(memory_);
    opened.reserve(gap_.size());
    for (std::uint32_t k = 0; k < gap_.size(); ++k)
      if (gap_[k] == kOpen && !whole_[k]) opened.push_back(k);
    for (std::size_t next = 0; next < opened.size(); ++next) {
      const int at = int(opened[next]);
      for_each_around(at % lattice_.columns, at / lattice_.columns, lattice_.columns, lattice_.rows,
                      [&](std::uint32_t k) {
                        if (gap_[k] != kUndecided) return;
                        gap_[k] = kOpen;
                        opened.push_back(k);
                      });
    }
    // A few open cells amid a bridge are noise of the verdicts: no occlusion is so small.
    std::fill(large_.begin(), large_.end(), std::uint8_t{0});
    for (const std::uint32_t k : opened) large_[k] = was_gap_[k];
    shaper_.drop_pieces_below(large_, std::size_t(kSpeckMm2 / cell_mm2_));
    for (const std::uint32_t k : opened)
      if (was_gap_[k] && !large_[k]) gap_[k] = kBridged;
    for (std::uint8_t& gap : gap_) gap = gap != kOpen;
  }

  // The first cell of the surface that way, or none within reach.
  std::optional<Cell> rim(Cell at, Cell way) const {
    const float mm =
        std::hypot(float(way.c) * lattice_.cell_width_mm, float(way.r) * lattice_.cell_height_mm);
    for (int n = int(limits_.max_gap_mm / mm) + 1; n > 0; --n) {
      at = {at.c + way.c, at.r + way.r};
      if (!lattice_.inside(at.c, at.r)) return std::nullopt;
      if (whole_[lattice_.index(at.c, at.r)]) return at;
    }
    return std::nullopt;
  }

  // The slope (depth over way across the line of sight) further out, looking outwards.
  float slope_behind(Cell rim, Cell way) const {
    Cell back = rim;
    for (int n = 2; n > 0; --n) {
      const Cell next{back.c + way.c, back.r + way.r};
      if (!lattice_.inside(next.c, next.r) || !whole_[lattice_.index(next.c, next.r)]) break;
      back = next;
    }
    const ViewEdge edge =
        back.c == rim.c && back.r == rim.r ? across_cell(rim, way) : edge_between(middle(rim), middle(back));
    return edge.depth_mm / edge.across_mm;
  }

  Vec3f middle(Cell at) const {
    const Vec3f* p = &lattice_.at_mm[lattice_.index(at.c, at.r)];
    const Vec3f* q = p + lattice_.columns;
    return times(plus(plus(p[0], p[1]), plus(q[0], q[1])), 0.25F);
  }

  ViewEdge across_cell(Cell at, Cell way) const {
    const Vec3f* p = &lattice_.at_mm[lattice_.index(at.c, at.r)];
    const Vec3f* q = p + lattice_.columns;
    const Vec3f right = times(minus(plus(p[1], q[1]), plus(p[0], q[0])), float(way.c) / 2);
    const Vec3f down = times(minus(plus(q[0], q[1]), plus(p[0], p[1])), float(way.r) / 2);
    return edge_between(middle(at), plus(middle(at), plus(right, down)));
  }

  PointLattice& lattice_;
  const LatticeLimits& limits_;
  MaskShaper& shaper_;
  float cell_mm_{std::min(lattice_.cell_width_mm, lattice_.cell_height_mm)},
      cell_mm2_{lattice_.cell_width_mm * lattice_.cell_height_mm};
  std::pmr::memory_resource* memory_;
  CellMask whole_{lattice_.size(), 0, memory_}, gap_{lattice_.size(), 0, memory_},
      was_gap_{lattice_.size(), 0, memory_}, large_{lattice_.size(), 0, memory_};
};

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
  CellMask gained(before, memory);
  shaper.erode(gained,
               1.5F * std::max(l.cell_width_mm, l.cell_height_mm));  // the steps along the old line too
  for (std::size_t k = 0; k < l.size(); ++k) {
    if (!before[k]) l.cells[k] = 0;
    gained[k] = wanted[k] && !gained[k] && triangle_count(l.cells[k]) < 2 && l.is_cell(k);
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

}  // namespace

void close_gaps(PointLattice& lattice, const LatticeLimits& limits, MaskShaper& shaper,
                std::pmr::memory_resource* memory) {
  if (limits.max_gap_mm <= 0) return;
  GapCloser(lattice, limits, shaper, memory).close();
}

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

CellMask trim_outline(PointLattice& l, const LatticeLimits& limits, MaskShaper& shaper,
                      std::pmr::memory_resource* memory) {
  CellMask all(l.size(), 0, memory);
  for (std::size_t k = 0; k < l.size(); ++k) all[k] = l.cells[k] != 0;
  shaper.fill_holes(all);
  CellMask kept(all, memory);
  const CellMask steep = steep_cells(l, limits.max_rim_slope, limits.rim_from_mm, memory);
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
    // Nicks are rounded off: see surface_shaping.h.
    CellMask near_outside(kept, memory);
    for (std::uint8_t& cell : near_outside) cell ^= 1;
    shaper.dilate(near_outside, kRimMm);
    for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = kept[k] && (l.cells[k] != 0 || !near_outside[k]);
    shaper.open(kept, limits.min_width_mm);
  }
  shaper.keep_largest_piece(kept);
  for (std::size_t k = 0; k < l.size(); ++k)
    if (!kept[k]) l.cells[k] = 0;
  return kept;
}

}  // namespace relievo::pipeline
