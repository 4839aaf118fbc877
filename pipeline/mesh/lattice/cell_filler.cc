// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/cell_filler.h"

#include <algorithm>
#include <vector>

#include "pipeline/mesh/lattice/thin_plate.h"

namespace relievo::pipeline {
namespace {

constexpr double kLeastRadiusMm = 1;
constexpr double kBesideMm = 2.5;  // over more than this a plate runs beside the surface it is like
constexpr double kBowMm =
    40;  // where nothing says otherwise skin bends back from a ball about the chart's centre, by 1 / this

// Twice the sigma of the carrying nodes nearby, from ring to ring.
void spread_sigma(PointLattice& lattice, const CellMask& carrying, std::span<const std::uint32_t> free,
                  std::pmr::memory_resource* memory) {
  CellMask known(carrying, memory);
  const auto place = [&](std::uint32_t k) {
    const int c = static_cast<int>(k) % lattice.columns;
    const int r = static_cast<int>(k) / lattice.columns;
    float sum = 0;
    float count = 0;
    for (int y = r - 1; y <= r + 1; ++y)
      for (int x = c - 1; x <= c + 1; ++x) {
        if (!lattice.inside(x, y) || !known[lattice.index(x, y)]) continue;
        sum += lattice.sigma_mm[lattice.index(x, y)] * (carrying[lattice.index(x, y)] ? 2 : 1);
        count += 1;
      }
    lattice.sigma_mm[k] = sum / count;
  };
  spread_inwards(lattice.columns, lattice.rows, free, known, place, memory);
  for (const std::uint32_t k : free)
    if (!known[k]) lattice.sigma_mm[k] = 1;  // an island without surface
}

// On a head's chart a node stays on its ray and the plate is one of radii: no fold can arise, and what
// nothing bends is round as a head is. Elsewhere each coordinate is a plate.
void place(PointLattice& l, std::span<const std::uint32_t> free, const CellMask& carrying,
           std::span<const double> like, std::pmr::memory_resource* memory) {
  PlateGrid grid{l.columns, l.rows, l.cell_height_mm / l.cell_width_mm};
  std::pmr::vector<double> value(l.size(), 0.0, memory);
  if (l.chart) {
    const double cell = static_cast<double>(l.cell_width_mm);
    grid.tension = cell / kBesideMm;
    grid.bow = -cell * cell / kBowMm;
    for (std::size_t k = 0; k < l.size(); ++k)
      if (carrying[k]) value[k] = l.radius_mm(k);
    relax_thin_plate(value, grid, free, carrying, like, memory);
    for (const std::uint32_t k : free) l.at_mm[k] = l.on_ray(k, std::max(value[k], kLeastRadiusMm));
    return;
  }
  for (float Vec3f::*const axis : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
    for (std::size_t k = 0; k < l.size(); ++k) value[k] = static_cast<double>(l.at_mm[k].*axis);
    relax_thin_plate(value, grid, free, carrying, {}, memory);
    for (const std::uint32_t k : free) l.at_mm[k].*axis = static_cast<float>(value[k]);
  }
}

}  // namespace

void fill_cells(PointLattice& lattice, LatticeSurface& surface, const CellMask& cells, float max_slope,
                std::span<const double> like, std::pmr::memory_resource* memory) {
  CellMask carrying(lattice.size(), 0, memory);
  CellMask listed(lattice.size(), 0, memory);
  for (int r = 0; r < lattice.rows; ++r)
    for (int c = 0; c < lattice.columns; ++c)
      carrying[lattice.index(c, r)] = carries_surface(lattice, surface, c, r);
  const std::size_t w = static_cast<std::size_t>(lattice.columns);
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells[k])
      for (const std::size_t corner : {k, k + 1, k + w, k + w + 1}) listed[corner] = !carrying[corner];
  std::pmr::vector<std::uint32_t> free(memory);
  free.reserve(static_cast<std::size_t>(std::count(listed.begin(), listed.end(), 1)));
  for (std::uint32_t k = 0; k < listed.size(); ++k)
    if (listed[k]) free.push_back(k);
  for (const std::uint32_t k : free) lattice.node[k] = Node::Filled;
  spread_sigma(lattice, carrying, free, memory);
  place(lattice, free, carrying, like, memory);
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells[k])
      if (const std::uint8_t cut = best_cut(lattice, k, max_slope)) surface.cells[k] = cut;
}

}  // namespace relievo::pipeline
