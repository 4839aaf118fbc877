// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "hal/base/statistics.h"
#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/mesh/meshers/base_sheet.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

constexpr float
    kSheetEdgeMm = 5,
    kSheetEdges = 6;  // what is fitted to a sheet closes holes by itself, and errs where the sheet spans them

bool usable(const CloudPoint& p) {
  return std::isfinite(p.at_mm.x) && std::isfinite(p.at_mm.y) && std::isfinite(p.at_mm.z) && p.at_mm.z > 0 &&
         std::isfinite(p.sigma_mm) && std::isfinite(p.left_px.x) && std::isfinite(p.left_px.y);
}

// Every k-th point, spread evenly over the cloud's order.
std::pmr::vector<std::pair<Kernel::Point_2, std::uint32_t>> plane_points(const PointCloud& cloud,
                                                                         int max_triangles, Arena& scratch) {
  const std::size_t most = std::size_t(max_triangles) / 2;
  const std::size_t wanted = std::min(most, cloud.points.size());
  std::pmr::vector<std::pair<Kernel::Point_2, std::uint32_t>> points(&scratch);
  points.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::size_t k = i * cloud.points.size() / wanted;
    const CloudPoint& p = cloud.points[k];
    if (usable(p))
      points.emplace_back(Kernel::Point_2(double(p.left_px.x), double(p.left_px.y)), std::uint32_t(k));
  }
  return points;
}

// Half of all edges are shorter.
float usual_edge_mm(const std::pmr::vector<Vec3f>& at, const std::pmr::vector<Triangle>& triangles,
                    Arena& scratch) {
  std::pmr::vector<float> lengths(&scratch);
  lengths.reserve(triangles.size());
  for (const Triangle& t : triangles) lengths.push_back(length(minus(at[t[1]], at[t[0]])));
  return lengths.empty() ? 0 : float(median(lengths));
}

bool shorter(const Vec3f& a, const Vec3f& b, const Vec3f& c, float longest_mm) {
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
    const Vec3f &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
    if (!shorter(a, b, c, longest_mm)) continue;
    area += double(std::abs(dot(cross(minus(b, a), minus(c, a)), unit(plus(plus(a, b), c))))) / 2;
    ++count;
  }
  return count > 0 ? std::sqrt(2 * area / double(count)) : 0;  // there are two triangles a point
}

bool belongs(const Vec3f& a, const Vec3f& b, const Vec3f& c, float longest_mm, float min_cosine) {
  return shorter(a, b, c, longest_mm) && facing(a, b, c, min_cosine);
}

// All triangles of the triangulation, wound counter-clockwise seen from the camera. In pixels y runs
// down, so CGAL's counter-clockwise is clockwise on the screen.
std::pmr::vector<Triangle> triangulate(const PointCloud& cloud, int max_triangles, Arena& scratch) {
  auto points = plane_points(cloud, max_triangles, scratch);
  Delaunay delaunay;
  delaunay.insert(points.begin(), points.end());
  std::pmr::vector<Triangle> triangles(&scratch);
  triangles.reserve(delaunay.number_of_faces());
  for (const auto& face : delaunay.finite_face_handles())
    triangles.push_back({face->vertex(0)->info(), face->vertex(2)->info(), face->vertex(1)->info()});
  // CGAL's order follows addresses in memory; ours is the same on every run.
  for (Triangle& t : triangles) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  std::ranges::sort(triangles);
  return triangles;
}

// `longest_mm`: of an edge, asked once all triangles are known.
template <typename Longest>
Result<FaceMesh> join(const PointCloud& cloud, const DelaunayMesher& options, StageContext& context,
                      Longest&& longest_mm) {
  const Error stopped{Errc::Cancelled, "meshing was stopped"};
  if (context.stop()) return stopped;
  if (cloud.points.size() < 3) return no_surface();
  std::pmr::vector<Triangle> triangles = triangulate(cloud, options.max_triangles, context.scratch);
  context.progress.done.store(0.6F, std::memory_order_relaxed);
  if (context.stop()) return stopped;

  std::pmr::vector<Vec3f> at(&context.scratch);
  at.reserve(cloud.points.size());
  for (const CloudPoint& p : cloud.points) at.push_back(p.at_mm);
  const float longest = longest_mm(at, triangles);
  const float min_cosine = float(std::cos(options.max_incidence_deg * std::numbers::pi / 180));
  std::erase_if(triangles, [&](const Triangle& t) {
    return !belongs(at[t[0]], at[t[1]], at[t[2]], longest, min_cosine);
  });
  keep_one_surface(at, triangles, {options.ear_passes}, &context.scratch);
  if (context.stop()) return stopped;
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

Result<FaceMesh> delaunay_sheet(const PointCloud& cloud, int max_triangles, StageContext& context) {
  DelaunayMesher options;
  options.max_triangles = max_triangles;
  return join(cloud, options, context, [&](const auto& at, const auto& triangles) {
    return std::min(kSheetEdgeMm, kSheetEdges * usual_edge_mm(at, triangles, context.scratch));
  });
}

}  // namespace relievo::pipeline
