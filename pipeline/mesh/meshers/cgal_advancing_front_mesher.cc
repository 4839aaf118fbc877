// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "pipeline/mesh/meshers/scattered_meshers.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Facet = std::array<std::size_t, 3>;

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
  for (const Triangle& t : triangles) {
    const Vec3f &a = base.vertices_mm[t[0]], &b = base.vertices_mm[t[1]], &c = base.vertices_mm[t[2]];
    const Vec3f u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
    away += (u.y * v.z - u.z * v.y) * a.x + (u.z * v.x - u.x * v.z) * a.y + (u.x * v.y - u.y * v.x) * a.z > 0;
  }
  if (2 * away > triangles.size())
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
  for (Triangle& t : triangles) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  std::ranges::sort(triangles);
  return triangles;
}

}  // namespace

Result<FaceMesh> AdvancingFrontMesher::mesh(const PointCloud& cloud, StageContext& context) const {
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  RELIEVO_TRY_ASSIGN(const FaceMesh base, base_sheet(cloud, max_points, context));
  const double longest =
      std::min(max_edge_mm, max_edge_ratio * double(usual_edge_mm(base, &context.scratch)));
  std::pmr::vector<Triangle> triangles = grow(base, longest, context);
  if (context.stop()) return Error{Errc::Cancelled, "meshing was stopped"};
  return finish_surface(base, base.vertices_mm, triangles, finish, context);
}

}  // namespace relievo::pipeline
