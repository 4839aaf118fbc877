// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "pipeline/mesh/lattice_surface.h"

namespace relievo::pipeline {
namespace {

// Steps (a king's on a chessboard) from every cell to the nearest one that is 0 in `distance`; the
// border of the lattice counts as 0 when `border` is 0. Two sweeps (Rosenfeld and Pfaltz 1966).
void grow_distances(const Lattice& l, std::pmr::vector<std::uint16_t>& distance, std::uint16_t border) {
  const auto at = [&](int c, int r) { return l.inside(c, r) ? distance[l.index(c, r)] : border; };
  const auto settle = [&](int c, int r, int back) {
    std::uint16_t& d = distance[l.index(c, r)];
    if (d == 0) return;
    const int least = std::min(std::min(at(c + back, r), at(c - 1, r + back)), std::min(at(c, r + back), at(c + 1, r + back)));
    d = static_cast<std::uint16_t>(std::min(static_cast<int>(d), least + 1));
  };
  for (int r = 0; r < l.rows; ++r)
    for (int c = 0; c < l.columns; ++c) settle(c, r, -1);
  for (int r = l.rows - 1; r >= 0; --r)
    for (int c = l.columns - 1; c >= 0; --c) settle(c, r, 1);
}

constexpr std::uint16_t kFar = 0x7FFF;

}  // namespace

void trim_outline(const Lattice& l, LatticeSurface& surface, int passes,
                  std::pmr::memory_resource* memory) {
  // Within two cells of a straight outline lie 25 to 30 triangles, of a right-angled corner 18.
  constexpr int kEnough = 22;
  std::pmr::vector<std::uint8_t> across(l.size(), 0, memory);
  std::pmr::vector<std::uint8_t> empty(static_cast<std::size_t>(l.columns), 0, memory);
  for (int pass = 0; pass < passes; ++pass) {
    for (int r = 0; r < l.rows; ++r) {
      const std::uint8_t* cell = &surface.cells[l.index(0, r)];
      std::uint8_t* sum = &across[l.index(0, r)];
      const auto at = [&](int c) { return c < 0 || c >= l.columns ? 0 : triangle_count(cell[c]); };
      int run = at(0) + at(1);
      for (int c = 0; c < l.columns; ++c) {
        run += at(c + 2) - at(c - 3);
        sum[c] = static_cast<std::uint8_t>(run);
      }
    }
    for (int r = 0; r < l.rows; ++r) {
      const std::uint8_t* band[5];
      for (int k = 0; k < 5; ++k) {
        const int row = r + k - 2;
        band[k] = row < 0 || row >= l.rows ? empty.data() : &across[l.index(0, row)];
      }
      std::uint8_t* cell = &surface.cells[l.index(0, r)];
      for (int c = 0; c < l.columns; ++c)
        if (band[0][c] + band[1][c] + band[2][c] + band[3][c] + band[4][c] < kEnough) cell[c] = 0;
    }
  }
}

void open_outline(const Lattice& l, LatticeSurface& surface, int radius_cells,
                  std::pmr::memory_resource* memory) {
  if (radius_cells <= 0 || l.size() == 0) return;
  std::pmr::vector<std::uint16_t> distance(l.size(), 0, memory);
  for (std::size_t k = 0; k < l.size(); ++k) distance[k] = triangle_count(surface.cells[k]) == 2 ? kFar : 0;
  grow_distances(l, distance, 0);
  for (std::uint16_t& d : distance) d = d > radius_cells ? 0 : kFar;  // 0: so deep inside that the square fits
  grow_distances(l, distance, kFar);
  for (std::size_t k = 0; k < l.size(); ++k)
    if (distance[k] > radius_cells + 1) surface.cells[k] = 0;
}

}  // namespace relievo::pipeline
