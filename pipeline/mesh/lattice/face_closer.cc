// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/lattice/face_closer.h"

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/landmarks/face_profile.h"
#include "pipeline/mesh/landmarks/face_relief.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/lattice/cell_filler.h"
#include "pipeline/mesh/lattice/outline.h"
#include "pipeline/mesh/lattice/thin_plate.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/mesh/triangle_raster.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

constexpr int kEvery = 3;               // nodes of the lattice a node of the rough surface that shows where the head is
constexpr float kBayMm = 4;             // half of the widest bay that belongs to the face; a wider one may be the view past a cheek
constexpr float kRimMm = 2;             // so near to a hole ...
constexpr float kSteepRim = 1.5F;       // ... surface steeper than this tangent was measured worst and is laid anew
constexpr double kStepCells = 8;        // of depth between neighbours, in widths of a cell: more is no slope
constexpr double kReliefMm = 60;        // around the tip of the nose: where what a camera does not see may lie behind what it sees
constexpr double kMostAsymmetryMm = 4, kDeepestMm = 12;
constexpr double kChinBelowPogonion = 22;
constexpr double kShortest = 70, kLongest = 110;  // of what lies below the tip of a nose
constexpr float kSteepest = 28.6F;      // tangent of 88 degrees

Vec3f narrow(const Vec3d& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Vec3d wide(const Vec3f& v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

// The measured surface, thinned out.
FaceMesh rough_surface(const PointLattice& l, const LatticeSurface& surface, Arena& scratch) {
  FaceMesh mesh(&scratch);
  std::pmr::vector<std::uint32_t> number(l.size(), 0, &scratch);
  for (int r = 0; r < l.rows; r += kEvery)
    for (int c = 0; c < l.columns; c += kEvery) {
      const std::size_t k = l.index(c, r);
      if (l.node[k] != Node::Measured) continue;
      mesh.vertices_mm.push_back(l.at_mm[k]);
      mesh.sigma_mm.push_back(l.sigma_mm[k]);
      mesh.measured.push_back(1);
      number[k] = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    }
  const auto whole = [&](int c, int r) {
    for (int y = r; y < r + kEvery; ++y)
      for (int x = c; x < c + kEvery; ++x)
        if (triangle_count(surface.cells[l.index(x, y)]) != 2) return false;
    return true;
  };
  for (int r = 0; r + kEvery < l.rows; r += kEvery)
    for (int c = 0; c + kEvery < l.columns; c += kEvery) {
      const std::uint32_t a = number[l.index(c, r)], b = number[l.index(c + kEvery, r)];
      const std::uint32_t o = number[l.index(c, r + kEvery)], d = number[l.index(c + kEvery, r + kEvery)];
      if (a == 0 || b == 0 || o == 0 || d == 0 || !whole(c, r)) continue;
      mesh.triangles.push_back({a - 1, o - 1, d - 1});
      mesh.triangles.push_back({a - 1, d - 1, b - 1});
    }
  compute_normals(mesh, 1, &scratch);
  return mesh;
}

FaceOutline outline_of(const FaceMesh& rough, const RigidTransform& head_from_here, Arena& scratch) {
  FaceOutline outline{head_from_here};
  const auto profile = profile_of(rough, head_from_here, &scratch);
  if (const auto chin = find_profile_marks(profile).chin) outline.below_mm = std::clamp(kChinBelowPogonion - chin->y_mm, kShortest, kLongest);
  return outline;
}

// Where surface stands before surface the step between them is nobody's curvature.
void forget_steps(std::pmr::vector<double>& inverse_depth, const PointLattice& l, Arena& scratch) {
  const double most = kStepCells * static_cast<double>(l.cell_width_mm);
  const std::pmr::vector<double> before(inverse_depth, &scratch);
  const auto parts = [&](std::size_t a, std::size_t b) { return before[a] != 0 && before[b] != 0 && std::abs(1 / before[a] - 1 / before[b]) > most; };
  for (int r = 0; r + 1 < l.rows; ++r)
    for (int c = 0; c + 1 < l.columns; ++c) {
      const std::size_t k = l.index(c, r), below = l.index(c, r + 1);
      if (parts(k, k + 1)) inverse_depth[k] = inverse_depth[k + 1] = 0;
      if (parts(k, below)) inverse_depth[k] = inverse_depth[below] = 0;
    }
}

// The other side of the face as the view would see it: inverse depths at every node, 0 where it shows nothing.
std::pmr::vector<double> mirrored(const FaceMesh& rough, const RigidTransform& head_from_here, const PointLattice& l, Arena& scratch) {
  const RigidTransform here_from_head = inverse(head_from_here);
  std::pmr::vector<double> inverse_depth(&scratch);
  std::pmr::vector<Vec2f> place(&scratch);
  inverse_depth.reserve(rough.vertices_mm.size());
  place.reserve(rough.vertices_mm.size());
  for (const Vec3f& v : rough.vertices_mm) {
    Vec3d in_head = apply(head_from_here, wide(v));
    in_head.x = -in_head.x;
    const Vec3d there = apply(here_from_head, in_head);
    const Vec2d px = l.view.project(there);
    inverse_depth.push_back(1 / apply(l.view.rectified_from_left, there).z);
    place.push_back({(static_cast<float>(px.x) - l.first_px.x) / l.step_px, (static_cast<float>(px.y) - l.first_px.y) / l.step_px});
  }
  std::pmr::vector<double> seen(l.size(), 0.0, &scratch);
  for (const auto& t : rough.triangles) {
    const std::uint32_t a = t[0], b = t[2], c = t[1];  // mirrored, they run the other way round
    const Vec2f &pa = place[a], &pb = place[b], &pc = place[c];
    if ((pb.x - pa.x) * (pc.y - pa.y) - (pb.y - pa.y) * (pc.x - pa.x) >= 0) continue;  // seen from behind
    for_each_texel(pa, pb, pc, l.columns, {0, l.rows}, [&](int x, int y, float wa, float wb, float wc) {
      double& nearest = seen[l.index(x, y)];
      nearest = std::max(nearest, static_cast<double>(wa) * inverse_depth[a] + static_cast<double>(wb) * inverse_depth[b] + static_cast<double>(wc) * inverse_depth[c]);
    });
  }
  forget_steps(seen, l, scratch);
  return seen;
}

// Before a hole the last rows of a nose's back are what the matcher's window mixed with the cheek behind: they would bend what
// is laid over the hole.
void drop_steep_rims(const PointLattice& l, LatticeSurface& surface, MaskShaper& shaper, Arena& scratch) {
  CellMask near(l.size(), 0, &scratch);
  for (std::size_t k = 0; k < l.size(); ++k) near[k] = triangle_count(surface.cells[k]) == 2;
  const CellMask whole(near, &scratch);
  shaper.fill_holes(near);
  for (std::size_t k = 0; k < l.size(); ++k) near[k] = near[k] && !whole[k];
  shaper.dilate(near, kRimMm);
  const CellMask steep = steep_cells(l, surface, kSteepRim, &scratch);
  for (std::size_t k = 0; k < l.size(); ++k)
    if (near[k] && steep[k]) surface.cells[k] = 0;
}

// The cells that shall carry surface and do not: gaps, and what the other side shows.
CellMask open_cells(const PointLattice& l, const LatticeSurface& surface, const FaceOutline& outline, std::span<const double> mirror, MaskShaper& shaper,
                    Arena& scratch) {
  constexpr float kAllowance = -3;
  CellMask whole(l.size(), 0, &scratch);
  for (std::size_t k = 0; k < l.size(); ++k) whole[k] = triangle_count(surface.cells[k]) == 2;
  CellMask open = whole;
  for (int r = 0; r + 1 < l.rows; ++r)
    for (int c = 0; c + 1 < l.columns; ++c) {
      const std::size_t k = l.index(c, r);
      const bool shown = mirror[k] > 0 && mirror[k + 1] > 0 && mirror[k + static_cast<std::size_t>(l.columns)] > 0;
      if (shown && outline.depth_mm(l.on_sight(k, 1 / mirror[k])) > kAllowance) open[k] = 1;
    }
  shaper.close(open, kBayMm, kBayMm);
  shaper.fill_holes(open);
  for (int r = 0; r < l.rows; ++r)
    for (int c = 0; c < l.columns; ++c) {
      const std::size_t k = l.index(c, r);
      const bool beyond = r < 1 || c < 1 || r + 2 >= l.rows || c + 2 >= l.columns ||
                          (l.node[k] == Node::Measured && outline.depth_mm(l.at_mm[k]) < 2 * kAllowance);
      open[k] = open[k] && !whole[k] && !beyond;
    }
  return open;
}

// What no line of sight from the middle reaches, the flank of a nose that is turned away, lies behind the sheet laid over it, and
// the other flank says how far: completed nodes in holes move along the head's axis to the mirrored surface, less what both sides
// differ by at the hole's rim.
void sink_to_mirror(PointLattice& l, const LatticeSurface& surface, const FaceMesh& rough, const RigidTransform& head_from_here, MaskShaper& shaper,
                    Arena& scratch) {
  FaceRelief relief({-kReliefMm, kReliefMm, -kReliefMm, kReliefMm, 1}, &scratch);
  relief.add(rough, head_from_here);
  CellMask hole(l.size(), 0, &scratch);
  for (std::size_t k = 0; k < l.size(); ++k) hole[k] = l.node[k] == Node::Filled && surface.cells[k] != 0;
  CellMask within(l.size(), 0, &scratch);  // what is completed at the outline is no hole
  for (std::size_t k = 0; k < l.size(); ++k) within[k] = surface.cells[k] != 0 && l.node[k] == Node::Measured;
  shaper.fill_holes(within);
  for (std::size_t k = 0; k < l.size(); ++k) hole[k] = hole[k] && within[k];
  CellMask rim = hole;
  shaper.dilate(rim, kRimMm);
  std::pmr::vector<double> sink(l.size(), 0.0, &scratch), differ(l.size(), 0.0, &scratch);
  std::pmr::vector<std::uint32_t> free(&scratch), shown(&scratch);
  std::pmr::vector<std::uint8_t> known(l.size(), 0, &scratch);
  for (std::uint32_t k = 0; k < l.size(); ++k) {
    if (!rim[k] || surface.cells[k] == 0) continue;
    const Vec3d p = apply(head_from_here, wide(l.at_mm[k]));
    const double there = relief.at(-p.x, p.y) - p.z;
    if (hole[k]) {
      free.push_back(k);
      sink[k] = there;
      if (!std::isnan(there)) shown.push_back(k);
    } else if (!std::isnan(there) && std::abs(there) < kMostAsymmetryMm) {
      known[k] = 1;
      differ[k] = there;
    }
  }
  if (shown.empty() || std::find(known.begin(), known.end(), 1) == known.end()) return;
  const PlateGrid grid{l.columns, l.rows, l.cell_height_mm / l.cell_width_mm};
  relax_thin_plate(differ, grid, free, known, {}, &scratch);
  for (std::uint32_t k = 0; k < l.size(); ++k)
    if (known[k]) differ[k] = 0;
  for (const std::uint32_t k : shown) {
    differ[k] = std::clamp(sink[k] - differ[k], -kDeepestMm, 0.0);  // never before what was seen
    known[k] = 1;
  }
  std::erase_if(free, [&](std::uint32_t k) { return known[k] != 0; });
  relax_thin_plate(differ, grid, free, known, {}, &scratch);
  const Rotation here_from_head = transposed(head_from_here.rotation);
  for (std::uint32_t k = 0; k < l.size(); ++k)
    if (hole[k]) l.at_mm[k] = mesh::plus(l.at_mm[k], narrow(apply(here_from_head, Vec3d{0, 0, std::min(differ[k], 0.0)})));
}

}  // namespace

Result<std::optional<FaceOutline>> close_face(PointLattice& lattice, LatticeSurface& surface, MaskShaper& shaper, StageContext& context) {
  const Arena::Mark mark(context.scratch);
  const FaceMesh rough = rough_surface(lattice, surface, context.scratch);
  const auto head = find_head_frame(rough, {}, context, lattice.view.at_mm);
  if (!head && head.error().code == Errc::Cancelled) return head.error();
  if (!head) return std::optional<FaceOutline>{};
  const FaceOutline outline = outline_of(rough, head->head_from_camera, context.scratch);
  drop_steep_rims(lattice, surface, shaper, context.scratch);
  const auto mirror = mirrored(rough, outline.head_from_here, lattice, context.scratch);
  const CellMask open = open_cells(lattice, surface, outline, mirror, shaper, context.scratch);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  fill_cells(lattice, surface, open, kSteepest, mirror, &context.scratch);
  sink_to_mirror(lattice, surface, rough, outline.head_from_here, shaper, context.scratch);
  return std::optional(outline);
}

}  // namespace relievo::pipeline
