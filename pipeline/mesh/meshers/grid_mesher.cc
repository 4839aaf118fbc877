// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/grid_mesher.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/mesh/detail/sliver_mender.h"
#include "pipeline/mesh/lattice/surface_shaping.h"
#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {
namespace {

constexpr double kCutAway = 0.018;      // of the triangles, by the outline's cut
constexpr float kThinnerStep = 1.003F;  // where the triangles at hand are exceeded by a few

float tangent(double degrees) { return float(std::tan(degrees * std::numbers::pi / 180)); }

// On a lattice that makes good use of the triangles there may be: of a face far away finer than the points',
// but not so fine that it would only repeat them; of a face near by coarser, above all towards the edges.
ShapedLattice fill_budget(ShapedLattice shaped, double triangles, float max_slope, const GridMesher& o,
                          StageContext& context) {
  const double present = expected_triangles(shaped, 1);
  if (present <= 0) return shaped;
  LatticeSpacing spacing{float(std::sqrt(present / triangles)), 1};
  if (double(spacing.cells) > o.finest_cells) {
    spacing.edge = float(o.edge_cells);
    spacing.cells = float(std::sqrt(expected_triangles(shaped, spacing.edge) / triangles));
  }
  spacing.cells = std::max(spacing.cells, float(o.finest_cells));
  while ((spacing.cells != 1 || spacing.edge != 1) && !context.stop()) {
    ShapedLattice other = resample_lattice(shaped, spacing, max_slope, context.pool, &context.scratch);
    if (expected_triangles(other, 1) <= triangles) return other;
    spacing.cells *= kThinnerStep;
  }
  return shaped;
}

Result<FaceMesh> make_surface(const PointCloud& cloud, double triangles, const GridMesher& o,
                              StageContext& context) {
  Arena& scratch = context.scratch;
  const Vec3d& right = cloud.right_camera_mm;
  const LatticeLimits limits{.max_slope = tangent(o.max_incidence_deg),
                             .step_sigmas = float(o.step_sigmas),
                             .step_slope_ratio = float(o.step_slope_ratio),
                             .min_step_mm = float(o.min_step_mm),
                             .max_gap_mm = float(o.max_hole_mm),
                             .max_bend = tangent(o.gap_bend_deg),
                             .max_rim_slope = tangent(o.max_rim_deg),
                             .rim_from_mm = narrow(times(right, 0.5)),
                             .min_width_mm = float(o.min_width_mm),
                             .wave_mm = float(o.outline_wave_mm),
                             .outline_mm = float(o.outline_smoothing_mm),
                             .rims_mm = float(o.rim_smoothing_mm)};
  PointLattice lattice = make_lattice(cloud, &scratch);
  join_neighbours(lattice, limits, &scratch);
  if (context.stop()) return stopped();
  if (!(lattice.cell_width_mm > 0 && lattice.cell_height_mm > 0)) return FaceMesh(&scratch);
  MaskShaper shaper(lattice.columns, lattice.rows, lattice.cell_width_mm, lattice.cell_height_mm, &scratch);
  close_gaps(lattice, limits, shaper, &scratch);
  if (context.stop()) return stopped();
  // After the gaps: a crack must not make a narrow place of a wide one.
  CellMask inside = trim_outline(lattice, limits, shaper, &scratch);
  if (context.stop()) return stopped();
  std::optional<ShapedLattice> closed;
  if (right.x != 0 || right.y != 0 || right.z != 0) {
    RELIEVO_TRY_ASSIGN(closed, close_face(lattice, right, limits, context));
  }
  const float max_slope = closed ? kSteepest : limits.max_slope;
  const ShapedLattice shaped =
      fill_budget(closed ? std::move(*closed) : ShapedLattice{std::move(lattice), std::move(inside)},
                  triangles, max_slope, o, context);
  if (context.stop()) return stopped();
  FaceMesh cut = cut_outline(shaped, limits, max_slope, &scratch);
  if (context.stop()) return stopped();
  {                                   // loose parts, ears and slivers that the cut has left
    const Arena::Mark mark(scratch);  // it takes triangles away and adds none
    keep_one_surface(cut.vertices_mm, cut.triangles, {}, &scratch);
    if (!context.stop() && mend_slivers(cut.vertices_mm, cut.triangles, max_slope, &scratch) > 0)
      keep_one_surface(cut.vertices_mm, cut.triangles, {.ear_passes = 0}, &scratch);
  }
  if (context.stop()) return stopped();
  if (shaped.outline) {  // seen from within a head: as the cameras see it
    for (Vec3f& v : cut.vertices_mm) v = plus(v, narrow(shaped.outline->chart.centre_mm));
    for (auto& t : cut.triangles) std::swap(t[1], t[2]);
  }
  return cut;
}

}  // namespace

Result<FaceMesh> GridMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  if (context.stop()) return stopped();
  if (cloud.points.empty()) return no_surface();
  if (cloud.lattice_step_px <= 0)
    return Error{
        Errc::Unsupported,
        "the grid mesher needs points on a pixel lattice: choose the mesher delaunay for scattered points"};

  // What the outline's cut takes is known once it is done: about a fiftieth, which may be had more of before.
  // Where it leaves too many, a thinner lattice fits.
  double triangles = (1 + kCutAway) * max_triangles;
  for (;;) {
    const Arena::Mark attempt(context.scratch);
    if (context.stop()) return stopped();
    RELIEVO_TRY_ASSIGN(const FaceMesh surface, make_surface(cloud, triangles, *this, context));
    context.progress.done.store(0.8F, std::memory_order_relaxed);
    if (surface.triangles.empty() || area_mm2(surface.vertices_mm, surface.triangles) < min_area_mm2)
      return no_surface();
    if (surface.triangles.size() > std::size_t(max_triangles)) {
      triangles *= 1 - kCutAway / 2;
      continue;
    }
    FaceMesh made = pack_mesh(surface.vertices_mm.size(), surface.triangles, context, [&](std::size_t v) {
      const bool certain = surface.sigma_mm[v] <= float(measured_sigma_mm);
      return PackedVertex{surface.vertices_mm[v], surface.sigma_mm[v],
                          certain ? surface.measured[v] : std::uint8_t{0}};
    });
    compute_normals(made, normal_passes, &context.scratch);
    turn_sigma_perpendicular(made);
    context.progress.done.store(1, std::memory_order_relaxed);
    return made;
  }
}

}  // namespace relievo::pipeline
