// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "pipeline/mesh/completion/head_sewing.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;

// The faces to the right of the border, and all that is reached from them without crossing it.
std::set<Triangulation::Face_handle> outside(const Triangulation& cdt,
                                             std::span<const std::array<std::uint32_t, 2>> border,
                                             const std::vector<Triangulation::Vertex_handle>& at,
                                             bool beyond_hull) {
  std::set<Triangulation::Face_handle> found;
  std::vector<Triangulation::Face_handle> stack;
  const auto reach = [&](Triangulation::Face_handle f) {
    if ((beyond_hull || !cdt.is_infinite(f)) && found.insert(f).second) stack.push_back(f);
  };
  for (const auto& [from, to] : border) {
    Triangulation::Face_handle face;
    int index = 0;
    // is_edge gives the face on the left of to -> from: the right of from -> to.
    if (at[from] != nullptr && at[to] != nullptr && cdt.is_edge(at[to], at[from], face, index)) {
      const bool left_of_back = face->vertex(Triangulation::ccw(index)) == at[to];
      reach(left_of_back ? face : face->neighbor(index));
    }
  }
  while (!stack.empty()) {
    const auto face = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k)
      if (!face->is_constrained(k)) reach(face->neighbor(k));
  }
  return found;
}

// A notch between places of the border alone; wider ones have added places within.
bool narrow(Triangulation::Face_handle face) {
  constexpr double kNarrow = 8;
  for (int k = 0; k < 3; ++k)
    if (CGAL::squared_distance(face->vertex(k)->point(), face->vertex((k + 1) % 3)->point()) >
        kNarrow * kNarrow)
      return false;
  return true;
}

}  // namespace

std::pmr::vector<Triangle> triangulate_gap(std::span<const Vec2f> plane,
                                           std::span<const std::array<std::uint32_t, 2>> border,
                                           std::span<const std::uint32_t> added,
                                           std::optional<std::uint32_t> far_point,
                                           std::pmr::memory_resource* memory) {
  Triangulation cdt;
  std::vector<Triangulation::Vertex_handle> at(plane.size());
  std::vector<char> is_added(plane.size(), 0);
  const auto insert = [&](std::uint32_t v) {
    if (at[v] != nullptr) return;
    const auto handle = cdt.insert(Kernel::Point_2(double(plane[v].x), double(plane[v].y)));
    handle->info() = v;
    at[v] = handle;
  };
  for (const auto& edge : border) insert(edge[0]), insert(edge[1]);
  for (const std::uint32_t v : added) insert(v), is_added[v] = 1;
  for (const auto& [from, to] : border)
    if (at[from] != at[to]) cdt.insert_constraint(at[from], at[to]);
  std::pmr::vector<Triangle> triangles(memory);
  for (const auto face : outside(cdt, border, at, far_point.has_value())) {
    Triangle t{};
    bool known = true, fresh = far_point && (cdt.is_infinite(face) || narrow(face));
    for (int k = 0; k < 3; ++k) {
      if (cdt.is_infinite(face->vertex(k))) {
        t[std::size_t(k)] = *far_point;
        continue;
      }
      const auto v = face->vertex(k)->info();
      // Where the border crosses itself in the plane, CGAL adds vertices of its own.
      known = known && v < plane.size() && at[v] == face->vertex(k);
      fresh = fresh || (known && is_added[v] != 0);
      t[std::size_t(k)] = v;
    }
    if (!known || !fresh) continue;
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    triangles.push_back(t);
  }
  std::ranges::sort(triangles);  // CGAL's order follows addresses
  return triangles;
}

}  // namespace relievo::pipeline
