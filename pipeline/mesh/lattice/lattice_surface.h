// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// LatticeSurface: which triangles each cell of a lattice carries. Cell (c, r) lies between the nodes
// (c, r) and (c + 1, r + 1); a bit per triangle, two ways to cut the cell:
//
//   falling:  a--b   kUnder = a d c, kOver  = a b d        rising:  a--b   kLeft = a b c, kRight = b d c
//             | \|                                                  | /|
//             c--d                                                  c--d
//
// A surface of cells is planar in the picture, so no edge can carry more than two triangles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/mesh/lattice/point_lattice.h"

namespace relievo::pipeline {

inline constexpr std::uint8_t kUnder = 1, kOver = 2, kLeft = 4, kRight = 8;
inline constexpr std::uint8_t kFalling = kUnder | kOver, kRising = kLeft | kRight;

struct LatticeLimits {
  float max_slope = 0;  // tangent of the steepest angle of incidence
  float step_sigmas = 0;
  float step_slope_ratio = 0;
  float min_step_mm = 0;
};

struct LatticeSurface {
  explicit LatticeSurface(std::pmr::memory_resource* memory) : cells(memory) {}
  std::pmr::vector<std::uint8_t> cells;  // as many as the lattice has nodes; last column and row empty
};

// Nodes of every triangle, counter-clockwise as the camera at the origin sees them.
template <typename Visit>
void for_each_triangle(const PointLattice& lattice, const LatticeSurface& surface, Visit&& visit) {
  const std::uint32_t w = static_cast<std::uint32_t>(lattice.columns);
  for (std::uint32_t a = 0; a < surface.cells.size(); ++a) {
    const std::uint8_t cell = surface.cells[a];
    if (cell & kUnder) visit(std::array<std::uint32_t, 3>{a, a + w, a + w + 1});
    if (cell & kOver) visit(std::array<std::uint32_t, 3>{a, a + w + 1, a + 1});
    if (cell & kLeft) visit(std::array<std::uint32_t, 3>{a, a + w, a + 1});
    if (cell & kRight) visit(std::array<std::uint32_t, 3>{a + 1, a + w, a + w + 1});
  }
}

inline int triangle_count(std::uint8_t cell) {
  return cell == 0 ? 0 : (cell == kFalling || cell == kRising) ? 2 : 1;
}

// Whether the node (column, row) and its neighbour (column + dx, row + dy) continue one surface.
bool continues(const PointLattice& lattice, const LatticeLimits& limits, int column, int row, int dx, int dy);

// Cuts every cell whose nodes continue one surface, along the shorter diagonal.
LatticeSurface join_neighbours(const PointLattice& lattice, const LatticeLimits& limits,
                               std::pmr::memory_resource* memory);

// Counter-clockwise seen from the camera, and no steeper than the angle of incidence with this cosine.
bool facing(const Vec3f& a, const Vec3f& b, const Vec3f& c, float min_cosine);
inline float cosine_of_slope(float slope) { return 1 / std::sqrt(1 + slope * slope); }

// The better way to cut the cell at index `k` whole, or 0 where either leaves a triangle steeper than
// `max_slope` or turned away.
std::uint8_t best_cut(const PointLattice& lattice, std::size_t k, float max_slope);

// Whether any triangle holds the node (column, row).
bool carries_surface(const PointLattice& lattice, const LatticeSurface& surface, int column, int row);

}  // namespace relievo::pipeline
