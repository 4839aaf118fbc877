// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/grid_mesher.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/mesh/lattice_surface.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

constexpr std::uint32_t kUnused = 0xFFFFFFFFU;

struct Stride { int x = 1, y = 1; };

// A lattice of n nodes carries at most 2 n triangles. Columns are thinned first: the rays of a pair
// side by side measure one row at a time, and rows carry the detail of eyes and lips.
Stride stride_for(std::size_t points, int max_triangles) {
  Stride stride;
  const auto too_many = [&] {
    return 2 * points > static_cast<std::size_t>(max_triangles) * static_cast<std::size_t>(stride.x) *
                            static_cast<std::size_t>(stride.y);
  };
  while (too_many()) ++(stride.x > stride.y ? stride.y : stride.x);
  return stride;
}

// The usual distance between neighbours; 0 where there are none.
float spacing_mm(const Lattice& lattice, const LatticeSurface& surface) {
  double sum = 0;
  double count = 0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (triangle_count(surface.cells[k]) < 2) continue;
    const std::size_t opposite = k + static_cast<std::size_t>(lattice.columns) + 1;
    sum += static_cast<double>(mesh::length(mesh::minus(lattice.at_mm[opposite], lattice.at_mm[k])));
    count += 1;
  }
  return count > 0 ? static_cast<float>(sum / count / std::numbers::sqrt2) : 0;
}

std::pmr::vector<Triangle> list_triangles(const Lattice& l, const LatticeSurface& surface, Arena& scratch) {
  std::size_t count = 0;
  for (const std::uint8_t cell : surface.cells) count += static_cast<std::size_t>(triangle_count(cell));
  std::pmr::vector<Triangle> triangles(&scratch);
  triangles.reserve(count);
  const std::uint32_t w = static_cast<std::uint32_t>(l.columns);
  for (std::uint32_t a = 0; a < surface.cells.size(); ++a) {
    const std::uint8_t cell = surface.cells[a];
    if (cell & kUnder) triangles.push_back({a, a + w, a + w + 1});
    if (cell & kOver) triangles.push_back({a, a + w + 1, a + 1});
    if (cell & kLeft) triangles.push_back({a, a + w, a + 1});
    if (cell & kRight) triangles.push_back({a + 1, a + w, a + w + 1});
  }
  return triangles;
}

FaceMesh pack(const Lattice& lattice, const std::pmr::vector<Triangle>& triangles, StageContext& context) {
  std::pmr::vector<std::uint32_t> place(lattice.size(), kUnused, &context.scratch);
  std::uint32_t used = 0;
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) place[v] = 0;
  for (std::uint32_t& p : place)
    if (p != kUnused) p = used++;

  FaceMesh mesh(&context.output);
  mesh.vertices_mm.reserve(used);
  mesh.normals.reserve(used);
  mesh.sigma_mm.reserve(used);
  mesh.measured.reserve(used);
  mesh.triangles.reserve(triangles.size());
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (place[k] == kUnused) continue;
    mesh.vertices_mm.push_back(lattice.at_mm[k]);
    mesh.sigma_mm.push_back(lattice.sigma_mm[k]);
    mesh.measured.push_back(lattice.node[k] == Node::Measured ? 1 : 0);
  }
  for (const Triangle& t : triangles) mesh.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return mesh;
}

LatticeSurface make_surface(Lattice& lattice, const GridMesherOptions& options, Arena& scratch) {
  const LatticeLimits limits{static_cast<float>(std::tan(options.max_incidence_deg * std::numbers::pi / 180)),
                             static_cast<float>(options.step_sigmas),
                             static_cast<float>(options.step_slope_ratio),
                             static_cast<float>(options.min_step_mm)};
  LatticeSurface surface = join_neighbours(lattice, limits, &scratch);
  trim_outline(lattice, surface, options.outline_passes, &scratch);
  const float spacing = spacing_mm(lattice, surface);
  std::size_t present = 0;
  for (const std::uint8_t cell : surface.cells) present += static_cast<std::size_t>(triangle_count(cell));
  const std::size_t most = static_cast<std::size_t>(options.max_triangles);
  if (spacing > 0 && present < most)
    fill_holes(lattice, surface, static_cast<int>(options.max_hole_mm / static_cast<double>(spacing)),
               limits.max_slope, most - present, &scratch);
  // After the holes: a pinhole must not make a narrow place of a wide one.
  if (spacing > 0)
    open_outline(lattice, surface, static_cast<int>(options.min_width_mm / 2 / static_cast<double>(spacing)), &scratch);
  return surface;
}

}  // namespace

Result<void> GridMesherOptions::check() const {
  if (max_triangles < 1000 || max_triangles > 10'000'000)
    return Error{Errc::InvalidInput, "max_triangles must lie in 1000 .. 10000000"}.at("mesher.grid");
  if (!(max_incidence_deg >= 30 && max_incidence_deg <= 89))
    return Error{Errc::InvalidInput, "max_incidence_deg must lie in 30 .. 89"}.at("mesher.grid");
  if (!(step_sigmas >= 0 && step_sigmas <= 100) || !(step_slope_ratio >= 1 && step_slope_ratio <= 100) ||
      !(min_step_mm >= 0 && min_step_mm <= 100))
    return Error{Errc::InvalidInput, "step_sigmas 0 .. 100, step_slope_ratio 1 .. 100, min_step_mm 0 .. 100"}.at("mesher.grid");
  if (!(max_hole_mm >= 0 && max_hole_mm <= 50))
    return Error{Errc::InvalidInput, "max_hole_mm must lie in 0 .. 50"}.at("mesher.grid");
  if (!(min_width_mm >= 0 && min_width_mm <= 50))
    return Error{Errc::InvalidInput, "min_width_mm must lie in 0 .. 50"}.at("mesher.grid");
  if (outline_passes < 0 || outline_passes > 16 || normal_passes < 0 || normal_passes > 16)
    return Error{Errc::InvalidInput, "outline_passes and normal_passes must lie in 0 .. 16"}.at("mesher.grid");
  if (!(min_area_mm2 >= 0 && min_area_mm2 <= 1e6))
    return Error{Errc::InvalidInput, "min_area_mm2 must lie in 0 .. 1000000"}.at("mesher.grid");
  return {};
}

Result<FaceMesh> GridMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  const Error stopped{Errc::Cancelled, "meshing was stopped"};
  const Error no_surface{Errc::PoorGeometry, "the points form no surface of a face's size: look straight into the cameras and try again"};
  RELIEVO_TRY(options_.check());
  if (context.stop()) return stopped;
  if (cloud.points.empty()) return no_surface;
  if (cloud.lattice_step_px <= 0)
    return Error{Errc::Unsupported, "the grid mesher needs points on a pixel lattice: choose the mesher delaunay for scattered points"};

  const Stride stride = stride_for(cloud.points.size(), options_.max_triangles);
  Lattice lattice = make_lattice(cloud, stride.x, stride.y, &context.scratch);
  context.progress.done.store(0.2F, std::memory_order_relaxed);
  if (context.stop()) return stopped;
  const LatticeSurface surface = make_surface(lattice, options_, context.scratch);
  context.progress.done.store(0.5F, std::memory_order_relaxed);
  if (context.stop()) return stopped;

  std::pmr::vector<Triangle> triangles = list_triangles(lattice, surface, context.scratch);
  keep_one_surface(lattice.at_mm, triangles, {}, &context.scratch);
  context.progress.done.store(0.8F, std::memory_order_relaxed);
  if (context.stop()) return stopped;
  if (triangles.empty() || area_mm2(lattice.at_mm, triangles) < options_.min_area_mm2) return no_surface;

  FaceMesh mesh = pack(lattice, triangles, context);
  compute_normals(mesh, options_.normal_passes, &context.scratch);
  turn_sigma_perpendicular(mesh);
  context.progress.done.store(1, std::memory_order_relaxed);
  return mesh;
}

}  // namespace relievo::pipeline
