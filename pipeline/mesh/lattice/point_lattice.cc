// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/point_lattice.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/view_edge.h"

namespace relievo::pipeline {
namespace {

constexpr float kLargestPixel = 100'000;  // beyond this a pixel is a mistake, not a picture

bool usable(const CloudPoint& p) {
  return std::isfinite(p.at_mm.x) && std::isfinite(p.at_mm.y) && p.at_mm.z > 0 && std::isfinite(p.at_mm.z) &&
         std::isfinite(p.sigma_mm) && p.sigma_mm >= 0 && std::abs(p.left_px.x) < kLargestPixel &&
         std::abs(p.left_px.y) < kLargestPixel;
}

struct Box {
  float left = kLargestPixel, top = kLargestPixel, right = -kLargestPixel, bottom = -kLargestPixel;
};

Box bounds(const PointCloud& cloud) {
  Box box;
  for (const CloudPoint& p : cloud.points) {
    if (!usable(p)) continue;
    box.left = std::min(box.left, p.left_px.x);
    box.right = std::max(box.right, p.left_px.x);
    box.top = std::min(box.top, p.left_px.y);
    box.bottom = std::max(box.bottom, p.left_px.y);
  }
  return box;
}

// Mean distance across the line of sight of neighbours so many columns and rows apart.
float usual_distance(const PointLattice& l, int dx, int dy) {
  double sum = 0;
  double count = 0;
  for (int r = 0; r + dy < l.rows; ++r)
    for (int c = 0; c + dx < l.columns; ++c) {
      const std::size_t a = l.index(c, r);
      const std::size_t b = l.index(c + dx, r + dy);
      if (l.node[a] == Node::Empty || l.node[b] == Node::Empty) continue;
      sum += static_cast<double>(mesh::edge_between(l.at_mm[a], l.at_mm[b]).across_mm);
      count += 1;
    }
  return count > 0 ? static_cast<float>(sum / count) : 0;
}

}  // namespace

void measure_cells(PointLattice& lattice) {
  lattice.cell_width_mm = usual_distance(lattice, 1, 0);
  lattice.cell_height_mm = usual_distance(lattice, 0, 1);
}

PointLattice make_lattice(const PointCloud& cloud, std::pmr::memory_resource* memory) {
  PointLattice lattice(memory);
  if (cloud.lattice_step_px <= 0) return lattice;
  const Box box = bounds(cloud);
  if (box.right < box.left) return lattice;

  const float step = static_cast<float>(cloud.lattice_step_px);
  const auto steps = [step](float from, float to) {
    return static_cast<int>(std::lround((to - from) / step));
  };
  lattice.columns = steps(box.left, box.right) + 1;
  lattice.rows = steps(box.top, box.bottom) + 1;
  const std::size_t nodes =
      static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows);
  lattice.node.assign(nodes, Node::Empty);
  lattice.at_mm.assign(nodes, Vec3f{});
  lattice.sigma_mm.assign(nodes, 0.0F);

  for (const CloudPoint& p : cloud.points) {
    if (!usable(p)) continue;
    const std::size_t k = lattice.index(steps(box.left, p.left_px.x), steps(box.top, p.left_px.y));
    if (lattice.node[k] != Node::Empty && lattice.sigma_mm[k] <= p.sigma_mm) continue;
    lattice.node[k] = Node::Measured;
    lattice.at_mm[k] = p.at_mm;
    lattice.sigma_mm[k] = p.sigma_mm;
  }
  measure_cells(lattice);
  return lattice;
}

}  // namespace relievo::pipeline
