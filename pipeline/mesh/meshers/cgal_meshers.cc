// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/mesh/meshers/band_volume.h"
#include "pipeline/mesh/meshers/base_sheet.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Facet = std::array<std::size_t, 3>;

// CGAL's order follows addresses in memory; ours is the same on every run.
void put_in_order(std::pmr::vector<Triangle>& triangles) {
  for (Triangle& t : triangles) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  std::ranges::sort(triangles);
}

// Refuses facets with an edge longer than the bound (as CGAL's manual suggests for open surfaces).
struct LongestEdge {
  double most_squared;

  template <typename AdvancingFront, typename Cell>
  double operator()(const AdvancingFront& front, Cell& cell, const int& index) const {
    double longest = 0;
    for (int i = 1; i <= 3; ++i)
      for (int j = i + 1; j <= 3; ++j)
        longest = std::max(longest, CGAL::squared_distance(cell->vertex((index + i) % 4)->point(),
                                                           cell->vertex((index + j) % 4)->point()));
    return longest > most_squared ? front.infinity() : front.smallest_radius_delaunay_sphere(cell, index);
  }
};

std::pmr::vector<Triangle> grow(const FaceMesh& base, double longest_mm, StageContext& context) {
  std::vector<Kernel::Point_3> points;
  points.reserve(base.vertices_mm.size());
  for (const Vec3f& v : base.vertices_mm) points.emplace_back(double(v.x), double(v.y), double(v.z));
  std::vector<Facet> facets;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(), std::back_inserter(facets),
                                               LongestEdge{longest_mm * longest_mm});
  std::pmr::vector<Triangle> triangles(&context.scratch);
  triangles.reserve(facets.size());
  for (const Facet& f : facets)
    triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[1]), std::uint32_t(f[2])});
  // CGAL orients the surface as one, either way round: towards the camera it shall be.
  std::size_t away = 0;
  for (const Triangle& t : triangles)
    away += dot(area_normal(base.vertices_mm, t), base.vertices_mm[t[0]]) > 0;
  if (2 * away > triangles.size())
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
  put_in_order(triangles);
  return triangles;
}

}  // namespace

Result<FaceMesh> AdvancingFrontMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const double longest =
      std::min(max_edge_mm,
               max_edge_ratio * double(usual_edge_mm(base.vertices_mm, base.triangles, &context.scratch)));
  std::pmr::vector<Triangle> triangles = grow(base, longest, context);
  if (context.stop()) return stopped();
  return finish_surface(base, base.vertices_mm, triangles, finish, context);
}

namespace {

using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;

constexpr double kBackMm = 60;
constexpr std::size_t kBackStride = 8;
constexpr int kSmoothings = 3;
constexpr float kSparse = 1.5F;  // voxels: the band joins points further apart

// Positive outside, at the voxels of the band. False where it was stopped or could not be solved.
bool fill_field(const FaceMesh& base, BandVolume& volume, float radius, StageContext& context) {
  std::vector<Oriented> points;
  points.reserve(base.vertices_mm.size() + base.vertices_mm.size() / kBackStride + 1);
  for (std::size_t i = 0; i < base.vertices_mm.size(); ++i) {
    const Vec3d p = wide(base.vertices_mm[i]), n = wide(base.normals[i]);
    points.emplace_back(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(n.x, n.y, n.z));
    // A face is an open sheet, and a flat one has no volume to refine: a coarse back, far behind, closes it.
    if (i % kBackStride != 0) continue;
    const double distance = length(p);
    const Kernel::Vector_3 away(p.x / distance, p.y / distance, p.z / distance);
    points.emplace_back(Kernel::Point_3(p.x, p.y, p.z) + kBackMm * away, away);
  }
  CGAL::Poisson_reconstruction_function<Kernel> inside(points.begin(), points.end(),
                                                       CGAL::First_of_pair_property_map<Oriented>(),
                                                       CGAL::Second_of_pair_property_map<Oriented>());
  if (context.stop() || !inside.compute_implicit_function()) return false;
  constexpr float kWanted = -1;  // marks the band, until its values are known
  const FaceMesh between = densify(base, kSparse * volume.voxel_mm, &context.scratch);
  for (const auto* near : {&base.vertices_mm, &between.vertices_mm})
    for (const Vec3f& p : *near)
      for_each_voxel_near(volume, p, radius,
                          [&](int x, int y, int z) { volume.value[volume.index(x, y, z)] = kWanted; });
  for (int z = 0; z < volume.nz && !context.stop(); ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x) {
        float& value = volume.value[volume.index(x, y, z)];
        if (std::isnan(value)) continue;
        const Vec3d at = wide(volume.at(x, y, z));
        value = float(inside(Kernel::Point_3(at.x, at.y, at.z)));
        if (!std::isfinite(value)) value = std::numeric_limits<float>::quiet_NaN();
      }
  return !context.stop();
}

}  // namespace

Result<FaceMesh> PoissonMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const float voxel =
      std::max(float(voxel_mm), 0.6F * usual_edge_mm(base.vertices_mm, base.triangles, &context.scratch));
  BandVolume volume = volume_around(base.vertices_mm, voxel, int(band_voxels) + 2, &context.scratch);
  if (!fill_field(base, volume, float(band_voxels) * voxel, context))
    return context.stop() ? stopped() : no_surface();
  const std::size_t row = std::size_t(volume.nx);
  for (int pass = 0; pass < kSmoothings; ++pass)
    for (const std::size_t stride : {std::size_t{1}, row, row * std::size_t(volume.ny)}) {
      // 1 2 1 along one direction, over what is known. CGAL's function is linear from vertex to vertex of its
      // triangulation: left alone, the surface shows its facets.
      const Arena::Mark line(context.scratch);
      const std::pmr::vector<float> before(volume.value, &context.scratch);
      for (std::size_t k = stride; k + stride < before.size(); ++k) {
        if (std::isnan(before[k])) continue;
        const float low = before[k - stride], high = before[k + stride];
        if (!std::isnan(low) && !std::isnan(high)) volume.value[k] = (low + 2 * before[k] + high) / 4;
      }
    }
  Polygonised surface = polygonise(volume, &context.scratch);
  return finish_surface(base, surface.vertices_mm, surface.triangles, finish, context);
}

namespace {

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

constexpr float
    kSheetEdgeMm = 5,
    kSheetEdges = 6;  // what is fitted to a sheet closes holes by itself, and errs where the sheet spans them

bool usable(const CloudPoint& p) {
  return std::isfinite(p.at_mm.x) && std::isfinite(p.at_mm.y) && std::isfinite(p.at_mm.z) && p.at_mm.z > 0 &&
         std::isfinite(p.sigma_mm) && std::isfinite(p.left_px.x) && std::isfinite(p.left_px.y);
}

bool shorter(std::span<const Vec3f> at, const Triangle& t, float longest_mm) {
  const Vec3f &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
  const float longest = longest_mm * longest_mm;
  return squared_distance(a, b) <= longest && squared_distance(b, c) <= longest &&
         squared_distance(c, a) <= longest;
}

// How far the points would lie from one another, spread evenly over the surface as the camera sees it: a
// hole's bridge is measured by that. Chosen places come in heaps, so that half of all edges are shorter by
// far.
double even_distance_mm(const std::pmr::vector<Vec3f>& at, const std::pmr::vector<Triangle>& triangles,
                        float longest_mm) {
  double area = 0;
  std::size_t count = 0;
  for (const Triangle& t : triangles) {
    if (!shorter(at, t, longest_mm)) continue;
    const Vec3f sight = unit(plus(plus(at[t[0]], at[t[1]]), at[t[2]]));
    area += double(std::abs(dot(area_normal(at, t), sight))) / 2;
    ++count;
  }
  return count > 0 ? std::sqrt(2 * area / double(count)) : 0;  // there are two triangles a point
}

// All triangles of the triangulation, wound counter-clockwise seen from the camera. In pixels y runs
// down, so CGAL's counter-clockwise is clockwise on the screen.
std::pmr::vector<Triangle> triangulate(const PointCloud& cloud, int max_triangles, Arena& scratch) {
  const std::size_t wanted = std::min(std::size_t(max_triangles) / 2, cloud.points.size());
  std::pmr::vector<std::pair<Kernel::Point_2, std::uint32_t>> points(&scratch);
  points.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) {  // every k-th point, spread evenly over the cloud's order
    const std::size_t k = i * cloud.points.size() / wanted;
    const CloudPoint& p = cloud.points[k];
    if (usable(p))
      points.emplace_back(Kernel::Point_2(double(p.left_px.x), double(p.left_px.y)), std::uint32_t(k));
  }
  Delaunay delaunay;
  delaunay.insert(points.begin(), points.end());
  std::pmr::vector<Triangle> triangles(&scratch);
  triangles.reserve(delaunay.number_of_faces());
  for (const auto& face : delaunay.finite_face_handles())
    triangles.push_back({face->vertex(0)->info(), face->vertex(2)->info(), face->vertex(1)->info()});
  put_in_order(triangles);
  return triangles;
}

// `longest_mm`: of an edge, asked once all triangles are known.
template <typename Longest>
Result<FaceMesh> join(const PointCloud& cloud, const DelaunayMesher& options, StageContext& context,
                      Longest&& longest_mm) {
  if (context.stop()) return stopped();
  if (cloud.points.size() < 3) return no_surface();
  std::pmr::vector<Triangle> triangles = triangulate(cloud, options.max_triangles, context.scratch);
  context.progress.done.store(0.6F, std::memory_order_relaxed);
  if (context.stop()) return stopped();

  std::pmr::vector<Vec3f> at(&context.scratch);
  at.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points) at.push_back(p.at_mm);
  const float longest = longest_mm(at, triangles);
  const float min_cosine = float(std::cos(options.max_incidence_deg * std::numbers::pi / 180));
  std::erase_if(triangles, [&](const Triangle& t) {
    return !shorter(at, t, longest) || !facing(at[t[0]], at[t[1]], at[t[2]], min_cosine);
  });
  keep_one_surface(at, triangles, {options.ear_passes}, &context.scratch);
  if (context.stop()) return stopped();
  if (triangles.empty() || area_mm2(at, triangles) < options.min_area_mm2) return no_surface();

  FaceMesh mesh = pack_mesh(at.size(), triangles, context, [&](std::size_t v) {
    const float sigma = cloud.points[v].sigma_mm;
    return PackedVertex{at[v], sigma, double(sigma) <= kMeasuredSigmaMm ? std::uint8_t{1} : std::uint8_t{0}};
  });
  compute_normals(mesh, options.normal_passes, &context.scratch);
  turn_sigma_perpendicular(mesh);
  context.progress.done.store(1, std::memory_order_relaxed);
  return mesh;
}

}  // namespace

Result<FaceMesh> DelaunayMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  return join(cloud, *this, context, [&](const auto& at, const auto& triangles) {
    const float most = float(max_edge_mm);
    return std::min(most, float(max_edge_ratio * even_distance_mm(at, triangles, most)));
  });
}

Result<FaceMesh> base_sheet(const PointCloud& cloud, int most_points, StageContext& context) {
  StageContext inner{context.scratch, context.scratch, context.pool, context.progress, context.cancelled};
  DelaunayMesher options;
  options.max_triangles = std::max(2 * most_points, 1000);
  return join(cloud, options, inner, [&](const auto& at, const auto& triangles) {
    return std::min(kSheetEdgeMm, kSheetEdges * usual_edge_mm(at, triangles, &context.scratch));
  });
}

}  // namespace relievo::pipeline
