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
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/mesh/lattice.h"

namespace relievo::pipeline {

inline constexpr std::uint8_t kUnder = 1, kOver = 2, kLeft = 4, kRight = 8;
inline constexpr std::uint8_t kFalling = kUnder | kOver, kRising = kLeft | kRight;

struct LatticeLimits {
  float max_slope = 0;         // tangent of the steepest angle of incidence
  float step_sigmas = 0;
  float step_slope_ratio = 0;
  float min_step_mm = 0;
};

struct LatticeSurface {
  explicit LatticeSurface(std::pmr::memory_resource* memory) : cells(memory) {}
  std::pmr::vector<std::uint8_t> cells;  // as many as the lattice has nodes; last column and row empty
};

inline int triangle_count(std::uint8_t cell) { return cell == 0 ? 0 : (cell == kFalling || cell == kRising) ? 2 : 1; }

// Cuts every cell whose nodes continue one surface, along the shorter diagonal.
LatticeSurface join_neighbours(const Lattice& lattice, const LatticeLimits& limits,
                               std::pmr::memory_resource* memory);

// Empties cells that hang on the surface like teeth or flakes: fewer triangles within two cells than
// a clean outline leaves there.
void trim_outline(const Lattice& lattice, LatticeSurface& surface, int passes,
                  std::pmr::memory_resource* memory);

// Empties whatever is too narrow for a square of 2 radius_cells + 1 cells (a morphological opening):
// whiskers and bridges that occlusion leaves along an outline. Wider parts keep their shape.
void open_outline(const Lattice& lattice, LatticeSurface& surface, int radius_cells,
                  std::pmr::memory_resource* memory);

// Closes holes at most `max_cells` wide and high with a thin-plate surface through their rim (nodes
// become Node::Filled); leaves those open that would need a slope steeper than `max_slope`.
// Returns the number of triangles added, which never exceeds `max_added`.
std::size_t fill_holes(Lattice& lattice, LatticeSurface& surface, int max_cells, float max_slope,
                       std::size_t max_added, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
