// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include "pipeline/fuse/rim.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Loop {
  std::vector<std::uint32_t> vertices;
  float length_mm = 0;
};

constexpr float kLeastDepthMm = 1;  // of a bay, on average

BorderEdge edge_between(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// Rims that pass through a vertex more than once are left open.
std::vector<Loop> loops_of(std::span<const Vec3f> vertices, std::span<const BorderEdge> border) {
  std::map<std::uint32_t, std::uint32_t> next;
  std::map<std::uint32_t, int> times;
  for (const BorderEdge& e : border) {
    next[e[0]] = e[1];
    ++times[e[0]];
  }
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop;
    bool plain = true;
    for (auto at = next.begin(); at != next.end();) {
      const auto [from, to] = *at;
      loop.vertices.push_back(from);
      loop.length_mm += distance(vertices[from], vertices[to]);
      plain = plain && times[from] == 1;
      next.erase(at);
      at = next.find(to);
    }
    if (!plain) loop.length_mm = 0;
    loops.push_back(std::move(loop));
  }
  return loops;
}

class Filler {
 public:
  Filler(std::span<const Vec3f> vertices, std::span<const BorderEdge> border,
         std::pmr::vector<Triangle>& triangles)
      : vertices_(vertices), on_rim_(vertices.size(), 0), triangles_(triangles) {
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
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(places, std::back_inserter(closing));
    std::vector<Triangle> made;
    for (const auto& t : closing) {
      const std::array<std::size_t, 3> at{static_cast<std::size_t>(t.first),
                                          static_cast<std::size_t>(t.second),
                                          static_cast<std::size_t>(t.third)};
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::size_t a = at[k], b = at[(k + 1) % 3]; !is_own(a, b) && !is_free(rim[a], rim[b]))
          return false;
      made.push_back({rim[at[0]], rim[at[1]], rim[at[2]]});
    }
    if (made.empty()) return false;
    for (const Triangle& t : made) take(t);
    triangles_.insert(triangles_.end(), made.begin(), made.end());
    return true;
  }

  // Stretches that run into the surface and come back to within a mouth's width: the largest first, none
  // within another. The rim has its surface on the left.
  void close_bays(const Loop& rim, std::span<const Vec3f> normals, const HoleLimits& limits) {
    struct Bay {
      std::size_t from, steps;
      float area_mm2;
    };
    const std::size_t n = rim.vertices.size();
    const auto vertex = [&](std::size_t i) { return rim.vertices[i % n]; };
    const auto at = [&](std::size_t i) { return vertices_[vertex(i)]; };
    const auto out_of = [&](std::size_t i, std::size_t j) {
      return unit(plus(unit(normals[vertex(i)]), unit(normals[vertex(j)])));
    };
    std::vector<Bay> bays;
    for (std::size_t i = 0; i < n; ++i) {
      Vec3f twice{};  // the area the stretch encloses
      float along = 0;
      for (std::size_t j = i + 1; j + 1 < i + n; ++j) {
        along += distance(at(j - 1), at(j));
        if (along > limits.rim_mm) break;
        twice = plus(twice, cross(minus(at(j - 1), at(i)), minus(at(j), at(i))));
        const float mouth = distance(at(i), at(j)), area = -dot(twice, out_of(i, j)) / 2;
        if (mouth <= limits.mouth_mm && area > kLeastDepthMm * mouth) bays.push_back({i, j - i, area});
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
      const std::size_t left = close(std::move(stretch)) ? 0 : bay.steps - bay.steps / 4;
      for (std::size_t k = bay.from + 1; k < to; ++k) longest[k % n] = left;
    }
  }

 private:
  bool is_free(std::uint32_t a, std::uint32_t b) const { return !taken_.contains(edge_between(a, b)); }
  void take(const Triangle& t) {
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::uint32_t a = t[i], b = t[(i + 1) % 3]; on_rim_[a] != 0 && on_rim_[b] != 0)
        taken_.insert(edge_between(a, b));
  }

  std::span<const Vec3f> vertices_;
  std::vector<char> on_rim_;
  std::set<BorderEdge> taken_;  // edges between vertices of rims, low then high
  std::pmr::vector<Triangle>& triangles_;
};

}  // namespace

void close_holes(std::span<const Vec3f> vertices, std::span<const Vec3f> normals,
                 std::span<const BorderEdge> border, const HoleLimits& limits,
                 std::pmr::vector<Triangle>& triangles) {
  const std::vector<Loop> loops = loops_of(vertices, border);
  const auto longest = std::max_element(
      loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.length_mm < b.length_mm; });
  Filler filler(vertices, border, triangles);
  for (auto loop = loops.begin(); loop != loops.end(); ++loop)
    if (loop != longest && loop->vertices.size() >= 3 && loop->length_mm > 0 &&
        loop->length_mm <= limits.rim_mm)
      filler.close(loop->vertices);
  if (longest != loops.end() && longest->length_mm > 0) filler.close_bays(*longest, normals, limits);
}

}  // namespace relievo::pipeline
