// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pipeline/mesh/lattice_surface.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

using mesh::cross, mesh::dot, mesh::minus, mesh::plus, mesh::squared_distance, mesh::times;

struct Hole {
  int left, top, right, bottom;  // of its cells, inclusive
  bool open;                     // reaches the border of the lattice: the outside
};

bool whole(std::uint8_t cell) { return triangle_count(cell) == 2; }

// Touched by any triangle of the four cells around it.
bool carries_surface(const Lattice& l, const LatticeSurface& s, int c, int r) {
  const auto cell = [&](int x, int y) { return l.inside(x, y) ? s.cells[l.index(x, y)] : std::uint8_t{0}; };
  return (cell(c, r) & (kUnder | kOver | kLeft)) || (cell(c - 1, r) & (kOver | kLeft | kRight)) ||
         (cell(c - 1, r - 1) & (kUnder | kOver | kRight)) || (cell(c, r - 1) & (kUnder | kLeft | kRight));
}

class HoleFiller {
 public:
  HoleFiller(Lattice& lattice, LatticeSurface& surface, int max_cells, float max_slope,
             std::pmr::memory_resource* memory)
      : lattice_(lattice), surface_(surface), max_cells_(max_cells),
        min_cosine_(1 / std::sqrt(1 + max_slope * max_slope)), seen_(lattice.size(), 0, memory),
        cells_(memory), unknown_(memory) {
    cells_.reserve(lattice.size());
    unknown_.reserve(static_cast<std::size_t>(max_cells + 1) * static_cast<std::size_t>(max_cells + 1));
  }

  std::size_t fill_all(std::size_t max_added) {
    std::size_t added = 0;
    for (int r = 0; r + 1 < lattice_.rows; ++r)
      for (int c = 0; c + 1 < lattice_.columns; ++c) {
        const std::size_t k = lattice_.index(c, r);
        if (seen_[k] || whole(surface_.cells[k])) continue;
        const Hole hole = collect(c, r);
        if (hole.open || hole.right - hole.left >= max_cells_ || hole.bottom - hole.top >= max_cells_) continue;
        if (added + 2 * cells_.size() > max_added) continue;
        added += fill(hole);
      }
    return added;
  }

 private:
  // Cells that meet in a corner belong to one hole, so that closing it leaves no bow-tie.
  Hole collect(int column, int row) {
    Hole hole{column, row, column, row, false};
    cells_.assign(1, static_cast<std::uint32_t>(lattice_.index(column, row)));
    seen_[cells_[0]] = 1;
    for (std::size_t next = 0; next < cells_.size(); ++next) {
      const int c = static_cast<int>(cells_[next]) % lattice_.columns;
      const int r = static_cast<int>(cells_[next]) / lattice_.columns;
      hole.left = std::min(hole.left, c);
      hole.right = std::max(hole.right, c);
      hole.bottom = std::max(hole.bottom, r);
      hole.open |= c == 0 || r == 0 || c + 2 >= lattice_.columns || r + 2 >= lattice_.rows;
      for (int y = std::max(r - 1, 0); y <= std::min(r + 1, lattice_.rows - 2); ++y)
        for (int x = std::max(c - 1, 0); x <= std::min(c + 1, lattice_.columns - 2); ++x) {
          const std::size_t k = lattice_.index(x, y);
          if (seen_[k] || whole(surface_.cells[k])) continue;
          seen_[k] = 1;
          cells_.push_back(static_cast<std::uint32_t>(k));
        }
    }
    return hole;
  }

  std::size_t fill(const Hole& hole) {
    unknown_.clear();
    for (int r = hole.top; r <= hole.bottom + 1; ++r)
      for (int c = hole.left; c <= hole.right + 1; ++c)
        if (belongs_to_hole(c, r)) unknown_.push_back(static_cast<std::uint32_t>(lattice_.index(c, r)));
    relax(hole);
    return cut_cells();
  }

  // A node is free where all cells around it are the hole's and empty. Nodes of other, nested pieces
  // of surface inside the bounding box carry triangles and stay.
  bool belongs_to_hole(int c, int r) const {
    if (carries_surface(lattice_, surface_, c, r)) return false;
    return c > 0 && r > 0 && !whole(surface_.cells[lattice_.index(c, r)]) && seen_[lattice_.index(c, r)];
  }

  // Gauss-Seidel: first the membrane, then the thin plate (bending energy), each until it rests. The
  // plate continues the curvature of the rim, so that a hole on a cheek does not become a dimple.
  void relax(const Hole& hole) {
    if (unknown_.empty()) return;
    Vec3f mean{};
    float sigma = 0;
    float rim = 0;
    for (const std::uint32_t cell : cells_)
      for (const std::size_t k : {std::size_t{cell}, std::size_t{cell} + 1}) {
        if (lattice_.node[k] == Node::Empty) continue;
        mean = plus(mean, lattice_.at_mm[k]);
        sigma += lattice_.sigma_mm[k];
        rim += 1;
      }
    for (const std::uint32_t k : unknown_) {
      lattice_.node[k] = Node::Filled;
      lattice_.at_mm[k] = rim > 0 ? times(mean, 1 / rim) : mean;
      lattice_.sigma_mm[k] = rim > 0 ? 2 * sigma / rim : 1;  // a guess is worth half a measurement at best
    }
    const int across = std::max(hole.right - hole.left, hole.bottom - hole.top) + 2;
    for (int turn = 0; turn < 4 * across; ++turn)
      for (const std::uint32_t k : unknown_) relax_membrane(k);
    for (int turn = 0; turn < 20 * across; ++turn)
      for (const std::uint32_t k : unknown_) relax_plate(k);
  }

  void relax_membrane(std::size_t k) {
    const std::size_t w = static_cast<std::size_t>(lattice_.columns);
    const auto& p = lattice_.at_mm;
    lattice_.at_mm[k] = times(plus(plus(p[k - 1], p[k + 1]), plus(p[k - w], p[k + w])), 0.25F);
  }

  void relax_plate(std::size_t k) {
    const std::ptrdiff_t w = lattice_.columns;
    const auto known = [&](std::ptrdiff_t n) {
      return n >= 0 && n < static_cast<std::ptrdiff_t>(lattice_.size()) &&
             lattice_.node[static_cast<std::size_t>(n)] != Node::Empty;
    };
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(k);
    for (const std::ptrdiff_t far : {-2 * w, std::ptrdiff_t{-2}, std::ptrdiff_t{2}, 2 * w, -w - 1, -w + 1, w - 1, w + 1})
      if (!known(i + far)) return relax_membrane(k);
    const auto at = [&](std::ptrdiff_t offset) -> const Vec3f& { return lattice_.at_mm[static_cast<std::size_t>(i + offset)]; };
    const Vec3f near = plus(plus(at(-1), at(1)), plus(at(-w), at(w)));
    const Vec3f diagonal = plus(plus(at(-w - 1), at(-w + 1)), plus(at(w - 1), at(w + 1)));
    const Vec3f far = plus(plus(at(-2), at(2)), plus(at(-2 * w), at(2 * w)));
    lattice_.at_mm[k] = times(minus(minus(times(near, 8), times(diagonal, 2)), far), 1.0F / 20);
  }

  bool facing(std::size_t a, std::size_t b, std::size_t c) const {
    const Vec3f& p = lattice_.at_mm[a];
    const Vec3f n = cross(minus(lattice_.at_mm[b], p), minus(lattice_.at_mm[c], p));
    const float towards = -dot(n, p);
    return towards > 0 && towards * towards >= min_cosine_ * min_cosine_ * dot(n, n) * dot(p, p);
  }

  std::uint8_t cut(std::size_t a) const {
    const std::size_t b = a + 1;
    const std::size_t o = a + static_cast<std::size_t>(lattice_.columns);
    const std::size_t d = o + 1;
    const bool falling = facing(a, o, d) && facing(a, d, b);
    const bool rising = facing(a, o, b) && facing(b, o, d);
    if (!falling && !rising) return 0;
    const bool shorter = squared_distance(lattice_.at_mm[a], lattice_.at_mm[d]) <=
                         squared_distance(lattice_.at_mm[b], lattice_.at_mm[o]);
    return falling && (shorter || !rising) ? kFalling : kRising;
  }

  // All or nothing: half a lid would leave a smaller hole with a ragged rim.
  std::size_t cut_cells() {
    for (const std::uint32_t cell : cells_) {
      if (cut(cell) != 0) continue;
      for (const std::uint32_t k : unknown_) lattice_.node[k] = Node::Empty;
      return 0;
    }
    std::size_t added = 0;
    for (const std::uint32_t cell : cells_) {
      added += static_cast<std::size_t>(2 - triangle_count(surface_.cells[cell]));
      surface_.cells[cell] = cut(cell);
    }
    return added;
  }

  Lattice& lattice_;
  LatticeSurface& surface_;
  int max_cells_;
  float min_cosine_;
  std::pmr::vector<std::uint8_t> seen_;
  std::pmr::vector<std::uint32_t> cells_;    // of the hole at hand
  std::pmr::vector<std::uint32_t> unknown_;  // its free nodes
};

}  // namespace

std::size_t fill_holes(Lattice& lattice, LatticeSurface& surface, int max_cells, float max_slope,
                       std::size_t max_added, std::pmr::memory_resource* memory) {
  if (max_cells <= 0 || lattice.size() == 0) return 0;
  return HoleFiller(lattice, surface, max_cells, max_slope, memory).fill_all(max_added);
}

}  // namespace relievo::pipeline
