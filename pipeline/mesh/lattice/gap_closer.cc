// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/gap_closer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "pipeline/mesh/lattice/cell_filler.h"

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
  GapCloser(PointLattice& lattice, const GapLimits& limits, MaskShaper& shaper,
            std::pmr::memory_resource* memory)
      : lattice_(lattice),
        limits_(limits),
        shaper_(shaper),
        cell_mm_(std::min(lattice.cell_width_mm, lattice.cell_height_mm)),
        cell_mm2_(lattice.cell_width_mm * lattice.cell_height_mm),
        whole_(lattice.size(), 0, memory),
        gap_(lattice.size(), 0, memory),
        was_gap_(lattice.size(), 0, memory),
        large_(lattice.size(), 0, memory),
        memory_(memory) {}

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
    const float radius = limits_.max_width_mm / 2;
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
      gap_[k] = gap_[k] && !large_[k] && inner(k);
      if (gap_[k]) lattice_.cells[k] = 0;
    }
    fill_cells(lattice_, gap_, limits_.max_slope, {}, memory_);
  }

  // Where a disc of the widest gap's size does not fit. The way back is a little longer than the way
  // out: the steps of a lattice along a slanted outline are no gaps.
  void find_gaps() {
    const float radius = (limits_.max_width_mm + cell_mm_) / 2;
    gap_ = whole_;
    shaper_.close(gap_, radius, radius + 0.75F * cell_mm_);
    for (std::size_t k = 0; k < gap_.size(); ++k)
      gap_[k] = was_gap_[k] = gap_[k] && !whole_[k] ? kUndecided : kOpen;
  }

  // Whether the shortest way across the gap continues the surface on its two sides. Undecided where no
  // way is short enough, as where two cracks cross.
  std::uint8_t bridge(Cell at) const {
    constexpr Cell kWays[] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    float narrowest = limits_.max_width_mm;
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
      const bool continues =
          continues_both(edge, width, -slope_behind(*from, {-way.c, -way.r}), slope_behind(*to, way));
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
      const int c = int(opened[next]) % lattice_.columns;
      const int r = int(opened[next]) / lattice_.columns;
      for (int y = std::max(r - 1, 0); y <= std::min(r + 1, lattice_.rows - 1); ++y)
        for (int x = std::max(c - 1, 0); x <= std::min(c + 1, lattice_.columns - 1); ++x) {
          const std::size_t k = lattice_.index(x, y);
          if (gap_[k] != kUndecided) continue;
          gap_[k] = kOpen;
          opened.push_back(std::uint32_t(k));
        }
    }
    bridge_specks(opened);
    for (std::uint8_t& gap : gap_) gap = gap != kOpen;
  }

  // A few open cells amid a bridge are noise of the verdicts: no occlusion is so small.
  void bridge_specks(std::span<const std::uint32_t> opened) {
    std::fill(large_.begin(), large_.end(), std::uint8_t{0});
    for (const std::uint32_t k : opened) large_[k] = was_gap_[k];
    shaper_.drop_pieces_below(large_, std::size_t(kSpeckMm2 / cell_mm2_));
    for (const std::uint32_t k : opened)
      if (was_gap_[k] && !large_[k]) gap_[k] = kBridged;
  }

  // Not of the last column or row, which are no cells.
  bool inner(std::size_t k) const {
    return lattice_.inside(int(k) % lattice_.columns + 1, int(k) / lattice_.columns + 1);
  }

  bool continues_both(const ViewEdge& edge, float width, float before, float after) const {
    const float most = std::max(before, after) * edge.across_mm;
    const float least = std::min(before, after) * edge.across_mm;
    const float allowed = limits_.min_step_mm + limits_.max_bend * width;
    return edge.depth_mm <= most + allowed && edge.depth_mm >= least - allowed;
  }

  // The first cell of the surface that way, or none within reach.
  std::optional<Cell> rim(Cell at, Cell way) const {
    const float mm =
        std::hypot(float(way.c) * lattice_.cell_width_mm, float(way.r) * lattice_.cell_height_mm);
    for (int n = int(limits_.max_width_mm / mm) + 1; n > 0; --n) {
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
  const GapLimits& limits_;
  MaskShaper& shaper_;
  float cell_mm_, cell_mm2_;
  CellMask whole_, gap_, was_gap_, large_;
  std::pmr::memory_resource* memory_;
};

}  // namespace

void close_gaps(PointLattice& lattice, const GapLimits& limits, MaskShaper& shaper,
                std::pmr::memory_resource* memory) {
  if (limits.max_width_mm <= 0) return;
  GapCloser(lattice, limits, shaper, memory).close();
}

}  // namespace relievo::pipeline
