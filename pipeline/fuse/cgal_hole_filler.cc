// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include "pipeline/fuse/rim.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Patch = CGAL::Surface_mesh<Kernel::Point_3>;

struct Loop {
  std::vector<std::uint32_t> vertices;
  float length_mm = 0;
};

constexpr float kLeastDepthMm = 1;  // of a bay, on average

BorderEdge edge_between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Loop> loops_of(std::span<const Vec3f> vertices, std::span<const BorderEdge> border) {
  std::map<std::uint32_t, std::uint32_t> next;
  for (const BorderEdge& e : border) next[e[0]] = e[1];
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    for (auto at = next.begin(); at != next.end();) {
      const auto [from, to] = *at;
      loop.vertices.push_back(from);
      loop.length_mm += distance(vertices[from], vertices[to]);
      next.erase(at);
      at = next.find(to);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

class Filler {
 public:
  Filler(std::pmr::vector<Vec3f>& vertices, std::span<const Vec3f> normals,
         std::span<const BorderEdge> border, std::pmr::vector<Triangle>& triangles)
      : vertices_(vertices), normals_(normals), on_rim_(vertices.size(), 0), triangles_(triangles) {
    for (const BorderEdge& e : border) on_rim_[e[0]] = 1;
    for (const Triangle& t : triangles) take(t);
  }

  // Places that follow one another as a rim does, closed by an edge that is the rim's own or free.
  bool close(std::vector<std::uint32_t> rim) {
    const auto is_own = [&](std::size_t a, std::size_t b) {
      return std::max(a, b) - std::min(a, b) == 1 ||
             (std::min(a, b) == 0 && std::max(a, b) + 1 == rim.size());
    };
    // The rim runs as its triangles do; what closes it runs the other way.
    std::reverse(rim.begin(), rim.end());
    std::vector<Kernel::Point_3> places;
    for (const std::uint32_t v : rim) places.emplace_back(vertices_[v].x, vertices_[v].y, vertices_[v].z);
    std::vector<CGAL::Triple<int, int, int>> closing;
    PMP::triangulate_hole_polyline(places, std::back_inserter(closing));
    if (closing.empty()) return false;
    Patch patch;
    for (const Kernel::Point_3& at : places) patch.add_vertex(at);
    for (const auto& t : closing) {
      const std::array<std::size_t, 3> at{std::size_t(t.first), std::size_t(t.second), std::size_t(t.third)};
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::size_t a = at[k], b = at[(k + 1) % 3]; !is_own(a, b) && !is_free(rim[a], rim[b]))
          return false;
      if (patch.add_face(vertex(t.first), vertex(t.second), vertex(t.third)) == Patch::null_face())
        return false;
    }
    refine(patch, places.size());
    for (const Patch::Edge_index e : patch.edges()) {
      const std::size_t a = patch.vertex(e, 0).idx(), b = patch.vertex(e, 1).idx();
      if (a < rim.size() && b < rim.size() && !is_own(a, b) && !is_free(rim[a], rim[b])) return false;
    }
    take_in(patch, rim);
    return true;
  }

  std::vector<std::uint32_t> beside() && { return std::move(beside_); }

  // Stretches that run into the surface and come back to within a mouth's width: the largest first, none
  // within another. The rim has its surface on the left.
  void close_bays(const Loop& rim, const HoleLimits& limits) {
    struct Bay {
      std::size_t from, steps;
      float area_mm2;
    };
    const std::size_t n = rim.vertices.size();
    const auto vertex = [&](std::size_t i) { return rim.vertices[i % n]; };
    const auto at = [&](std::size_t i) { return vertices_[vertex(i)]; };
    const auto out_of = [&](std::size_t i, std::size_t j) {
      return unit(plus(unit(normals_[vertex(i)]), unit(normals_[vertex(j)])));
    };
    std::vector<float> widest, steps;
    for (std::size_t i = 0; i < n; ++i) {
      widest.push_back(limits.mouth_mm(at(i)));
      steps.push_back(distance(at(i), at(i + 1)));
    }
    std::vector<Bay> bays;
    for (std::size_t i = 0; i < n; ++i) {
      Vec3f twice{};  // the area the stretch encloses
      float along = 0;
      for (std::size_t j = i + 1; j + 1 < i + n; ++j) {
        along += steps[(j - 1) % n];
        if (along > limits.rim_mm) break;
        twice = plus(twice, cross(minus(at(j - 1), at(i)), minus(at(j), at(i))));
        const float mouth = distance(at(i), at(j));
        if (mouth > std::min(widest[i], widest[j % n])) continue;
        const float area = -dot(twice, out_of(i, j)) / 2;
        if (area > kLeastDepthMm * mouth) bays.push_back({i, j - i, area});
      }
    }
    std::sort(bays.begin(), bays.end(), [](const Bay& a, const Bay& b) {
      return std::tuple(-a.area_mm2, a.steps, a.from) < std::tuple(-b.area_mm2, b.steps, b.from);
    });
    // How long a bay may be there: where one did not close, a shorter one may; in one that did, none.
    std::vector<std::size_t> longest(n, n);
    for (const Bay& bay : bays) {
      const std::size_t to = bay.from + bay.steps;
      const Vec3f mouth = minus(at(to), at(bay.from)), out = out_of(bay.from, to);
      bool possible = longest[bay.from] > 0 && longest[to % n] > 0 && is_free(vertex(bay.from), vertex(to));
      for (std::size_t k = bay.from + 1; k < to && possible; ++k)
        possible = longest[k % n] >= bay.steps &&
                   dot(cross(mouth, minus(at(k), at(bay.from))), out) > -kLeastDepthMm * length(mouth);
      if (!possible) continue;
      std::vector<std::uint32_t> stretch;
      for (std::size_t k = bay.from; k <= to; ++k) stretch.push_back(vertex(k));
      const std::size_t left = close_bay(std::move(stretch)) ? 0 : bay.steps - bay.steps / 4;
      for (std::size_t k = bay.from + 1; k < to; ++k) longest[k % n] = left;
    }
  }

 private:
  static Patch::Vertex_index vertex(int i) { return Patch::Vertex_index(static_cast<Patch::size_type>(i)); }

  // Its mouth gets vertices as dense as those of its shore.
  bool close_bay(std::vector<std::uint32_t> stretch) {
    float shore = 0;
    for (std::size_t k = 1; k < stretch.size(); ++k)
      shore += distance(vertices_[stretch[k - 1]], vertices_[stretch[k]]);
    const std::uint32_t from = stretch.back(), to = stretch.front();
    const float step = shore / float(stretch.size() - 1);
    const int steps = std::max(1, int(distance(vertices_[from], vertices_[to]) / step));
    // A cubic curve between two ends that leaves them as the surface does (PN triangles: Vlachos and others
    // 2001).
    const Vec3f a = vertices_[from], d = vertices_[to], way = minus(d, a);
    const Vec3f n = unit(normals_[from]), m = unit(normals_[to]);
    const Vec3f b = along(along(a, 1.0F / 3, way), -dot(way, n) / 3, n);
    const Vec3f c = along(along(d, -1.0F / 3, way), dot(way, m) / 3, m);
    const std::size_t before = vertices_.size();
    for (int k = 1; k < steps; ++k) {
      stretch.push_back(std::uint32_t(vertices_.size()));
      const float u = float(k) / float(steps), v = 1 - u;
      vertices_.push_back(
          along(along(along(times(a, v * v * v), 3 * v * v * u, b), 3 * v * u * u, c), u * u * u, d));
      beside_.push_back(from);
      on_rim_.push_back(1);
    }
    if (close(std::move(stretch))) return true;
    vertices_.resize(before);
    beside_.resize(beside_.size() - std::size_t(steps - 1));
    on_rim_.resize(before);
    return false;
  }

  // A triangle whose corners all lie on the rim gets one in its middle.
  static void refine(Patch& patch, std::size_t rim) {
    std::vector<Patch::Face_index> faces;
    std::vector<Patch::Vertex_index> added;
    PMP::refine(patch, std::vector<Patch::Face_index>(patch.faces().begin(), patch.faces().end()),
                std::back_inserter(faces), std::back_inserter(added));
    faces.assign(patch.faces().begin(), patch.faces().end());
    for (const Patch::Face_index f : faces) {
      const auto corners = patch.vertices_around_face(patch.halfedge(f));
      if (std::any_of(corners.begin(), corners.end(), [&](Patch::Vertex_index v) { return v.idx() >= rim; }))
        continue;
      std::vector<Kernel::Point_3> at;
      for (const Patch::Vertex_index v : corners) at.push_back(patch.point(v));
      const auto middle = CGAL::Euler::add_center_vertex(patch.halfedge(f), patch);
      patch.point(patch.target(middle)) = CGAL::centroid(at[0], at[1], at[2]);
    }
  }

  void take_in(const Patch& patch, std::span<const std::uint32_t> rim) {
    std::vector<std::uint32_t> place(rim.begin(), rim.end());
    for (std::size_t i = rim.size(); i < patch.number_of_vertices(); ++i) {
      const Kernel::Point_3& at = patch.point(vertex(int(i)));
      place.push_back(std::uint32_t(vertices_.size()));
      vertices_.push_back({float(at.x()), float(at.y()), float(at.z())});
      beside_.push_back(rim.back());
      on_rim_.push_back(0);
    }
    for (const Patch::Face_index f : patch.faces()) {
      Triangle t{};
      std::size_t k = 0;
      for (const Patch::Vertex_index v : patch.vertices_around_face(patch.halfedge(f)))
        t[k++] = place[v.idx()];
      take(t);
      triangles_.push_back(t);
    }
  }

  bool is_free(std::uint32_t a, std::uint32_t b) const { return !taken_.contains(edge_between(a, b)); }
  void take(const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::uint32_t a = t[i], b = t[(i + 1) % 3]; on_rim_[a] != 0 && on_rim_[b] != 0)
        taken_.insert(edge_between(a, b));
  }

  std::pmr::vector<Vec3f>& vertices_;
  std::span<const Vec3f> normals_;  // of those that were there
  std::vector<char> on_rim_;
  std::set<BorderEdge> taken_;  // edges between vertices of rims, low then high
  std::pmr::vector<Triangle>& triangles_;
  std::vector<std::uint32_t> beside_;
};

}  // namespace

ClosedHoles close_holes(std::pmr::vector<Vec3f>& vertices_mm, std::span<const Vec3f> normals,
                        std::span<const BorderEdge> border, const HoleLimits& limits,
                        std::pmr::vector<Triangle>& triangles) {
  const std::vector<Loop> loops = loops_of(vertices_mm, border);
  const auto longest = std::max_element(
      loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.length_mm < b.length_mm; });
  Filler filler(vertices_mm, normals, border, triangles);
  std::vector<std::uint32_t> left_open;
  for (auto loop = loops.begin(); loop != loops.end(); ++loop)
    if (loop != longest && loop->length_mm <= limits.rim_mm && !filler.close(loop->vertices))
      left_open.insert(left_open.end(), loop->vertices.begin(), loop->vertices.end());
  if (longest != loops.end()) filler.close_bays(*longest, limits);
  return {std::move(filler).beside(), std::move(left_open)};
}

}  // namespace relievo::pipeline
