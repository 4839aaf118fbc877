// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/cell_filler.h"

#include <algorithm>
#include <vector>

#include "pipeline/mesh/lattice/thin_plate.h"

namespace relievo::pipeline {
namespace {

float usual_sigma(const PointLattice& lattice, const CellMask& carrying, std::uint32_t k) {
  const int c = static_cast<int>(k) % lattice.columns;
  const int r = static_cast<int>(k) / lattice.columns;
  float sum = 0;
  float count = 0;
  for (int reach = 1; count == 0 && reach < std::max(lattice.columns, lattice.rows); ++reach)
    for (int y = r - reach; y <= r + reach; ++y)
      for (int x = c - reach; x <= c + reach; ++x) {
        if (!lattice.inside(x, y) || !carrying[lattice.index(x, y)]) continue;
        sum += lattice.sigma_mm[lattice.index(x, y)];
        count += 1;
      }
  return count > 0 ? sum / count : 1;
}

}  // namespace

void fill_cells(PointLattice& lattice, LatticeSurface& surface, const CellMask& cells, float max_slope,
                std::pmr::memory_resource* memory) {
  CellMask carrying(lattice.size(), 0, memory);
  CellMask listed(lattice.size(), 0, memory);
  for (int r = 0; r < lattice.rows; ++r)
    for (int c = 0; c < lattice.columns; ++c) carrying[lattice.index(c, r)] = carries_surface(lattice, surface, c, r);
  const std::size_t w = static_cast<std::size_t>(lattice.columns);
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells[k])
      for (const std::size_t corner : {k, k + 1, k + w, k + w + 1}) listed[corner] = !carrying[corner];
  std::pmr::vector<std::uint32_t> free(memory);
  free.reserve(static_cast<std::size_t>(std::count(listed.begin(), listed.end(), 1)));
  for (std::uint32_t k = 0; k < listed.size(); ++k)
    if (listed[k]) free.push_back(k);
  for (const std::uint32_t k : free) {
    lattice.node[k] = Node::Filled;
    lattice.sigma_mm[k] = 2 * usual_sigma(lattice, carrying, k);
  }
  relax_thin_plate(lattice, free, carrying, memory);
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells[k])
      if (const std::uint8_t cut = best_cut(lattice, k, max_slope)) surface.cells[k] = cut;
}

}  // namespace relievo::pipeline
