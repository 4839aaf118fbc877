// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/surface_cleaner.h"

#include <algorithm>
#include <cmath>

namespace relievo::pipeline {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

double triangle_area(std::span<const Vec3f> v, const Triangle& t) {
  return 0.5 * double(length(area_normal(v, t)));
}

// Triangles with their neighbours; triangles die, they are never moved.
class Soup {
 public:
  Soup(std::span<const Vec3f> vertices, std::span<const Triangle> triangles,
       std::pmr::memory_resource* memory)
      : vertices_(vertices), triangles_(triangles), memory_(memory) {
    stack_.reserve(triangles.size());
    group_around(around_, vertices.size(), triangles);
    find_neighbours();
  }

  bool alive(std::size_t t) const { return alive_[t] != 0; }

  // Each pass takes only what the boundary was when it began, so that it cannot eat its way inwards.
  std::size_t drop_ears() {
    stack_.clear();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (alive_[t] && neighbours(t) <= 1) stack_.push_back(t);
    for (const std::uint32_t t : stack_) alive_[t] = 0;
    return stack_.size();
  }

  void keep_largest_component() {
    std::ranges::fill(mark_, kNone);
    std::uint32_t best = kNone;
    double best_area = -1;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!alive_[t] || mark_[t] != kNone) continue;
      const double area = flood(t);
      if (area > best_area) {
        best_area = area;
        best = t;
      }
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) alive_[t] = alive_[t] && mark_[t] == best;
  }

  // At a vertex of one open fan, triangles exceed shared edges by one; at a closed fan they are equal.
  std::size_t split_bow_ties() {
    std::ranges::fill(corners_, std::uint16_t{0});
    std::ranges::fill(inner_, std::uint16_t{0});
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!alive_[t]) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        ++corners_[triangles_[t][k]];
        if (!joined(t, k)) continue;
        ++inner_[triangles_[t][k]];
        ++inner_[triangles_[t][(k + 1) % 3]];
      }
    }
    std::size_t dropped = 0;
    for (std::uint32_t v = 0; v < vertices_.size(); ++v)
      if (2 * corners_[v] >= inner_[v] + 4) dropped += keep_largest_fan(v);
    return dropped;
  }

 private:
  void find_neighbours() {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        if (across_[3 * t + k] != kNone) continue;
        const std::uint32_t from = triangles_[t][k];
        const std::uint32_t to = triangles_[t][(k + 1) % 3];
        for (const std::uint32_t there : around_[from]) {
          const Triangle& other = triangles_[there];
          const std::size_t j = other[0] == to ? 0 : other[1] == to ? 1 : 2;
          if (other[j] != to || other[(j + 1) % 3] != from) continue;
          across_[3 * t + k] = there;
          across_[3 * there + j] = t;
          break;
        }
      }
  }

  bool joined(std::uint32_t t, std::size_t k) const {
    const std::uint32_t other = across_[3 * std::size_t{t} + k];
    return other != kNone && alive_[other];
  }
  int neighbours(std::uint32_t t) const { return joined(t, 0) + joined(t, 1) + joined(t, 2); }

  double flood(std::uint32_t seed) {
    double area = 0;
    stack_.assign(1, seed);
    mark_[seed] = seed;
    while (!stack_.empty()) {
      const std::uint32_t t = stack_.back();
      stack_.pop_back();
      area += triangle_area(vertices_, triangles_[t]);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = across_[3 * std::size_t{t} + k];
        if (other == kNone || !alive_[other] || mark_[other] != kNone) continue;
        mark_[other] = seed;
        stack_.push_back(other);
      }
    }
    return area;
  }

  // The triangles that hang together with `start` by edges at `v`, in stack_.
  void collect_fan(std::uint32_t v, std::uint32_t start) {
    stack_.assign(1, start);
    for (std::size_t next = 0; next < stack_.size(); ++next) {
      const std::uint32_t t = stack_[next];
      for (std::size_t k = 0; k < 3; ++k) {
        if (triangles_[t][k] != v && triangles_[t][(k + 1) % 3] != v) continue;
        const std::uint32_t other = across_[3 * std::size_t{t} + k];
        if (other == kNone || !alive_[other]) continue;
        if (std::ranges::find(stack_, other) == stack_.end()) stack_.push_back(other);
      }
    }
  }

  std::size_t keep_largest_fan(std::uint32_t v) {
    std::uint32_t keep = kNone;
    std::size_t longest = 0;
    for (const std::uint32_t t : around_[v]) {
      if (!alive_[t]) continue;
      collect_fan(v, t);
      if (stack_.size() > longest) {
        longest = stack_.size();
        keep = t;
      }
    }
    if (keep == kNone) return 0;
    collect_fan(v, keep);
    std::size_t dropped = 0;
    for (const std::uint32_t t : around_[v]) {
      if (!alive_[t] || std::ranges::find(stack_, t) != stack_.end()) continue;
      alive_[t] = 0;
      ++dropped;
    }
    return dropped;
  }

  std::span<const Vec3f> vertices_;
  std::span<const Triangle> triangles_;
  std::pmr::memory_resource* memory_;
  Groups around_{memory_};  // triangles around each vertex
  // The triangle behind each edge.
  std::pmr::vector<std::uint32_t> across_{3 * triangles_.size(), kNone, memory_};
  std::pmr::vector<std::uint8_t> alive_{triangles_.size(), 1, memory_};
  std::pmr::vector<std::uint32_t> mark_{triangles_.size(), kNone, memory_}, stack_{memory_};
  std::pmr::vector<std::uint16_t> corners_{vertices_.size(), 0, memory_},
      inner_{vertices_.size(), 0, memory_};
};

}  // namespace

std::pmr::vector<BorderEdge> directed_edges(std::span<const Triangle> triangles,
                                            std::pmr::memory_resource* memory) {
  std::pmr::vector<BorderEdge> edges(memory);
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3]});
  std::ranges::sort(edges);
  return edges;
}

std::pmr::vector<BorderEdge> border_edges(std::span<const Triangle> triangles,
                                          std::pmr::memory_resource* memory) {
  std::uint32_t most = 0;
  for (const Triangle& t : triangles) most = std::max({most, t[0], t[1], t[2]});
  // By the vertex of the lower number: of each of its edges the other end, doubled, and one more where the
  // triangle runs back from there.
  Groups ends(memory);
  ends.sort(std::size_t{most} + 1, [&](auto&& add) {
    for (const Triangle& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = t[i], to = t[(i + 1) % 3];
        from < to ? add(from, 2 * to) : add(to, 2 * from + 1);
      }
  });
  std::pmr::vector<BorderEdge> border(memory);
  std::pmr::vector<std::uint32_t> mine(memory);
  for (std::uint32_t low = 0; low < ends.size(); ++low) {
    mine.assign(ends[low].begin(), ends[low].end());
    std::ranges::sort(mine);
    for (std::size_t i = 0, after = 0; i < mine.size(); i = after) {
      while (after < mine.size() && mine[after] / 2 == mine[i] / 2) ++after;
      const std::uint32_t high = mine[i] / 2;
      if (after - i == 1) border.push_back(mine[i] % 2 == 0 ? BorderEdge{low, high} : BorderEdge{high, low});
    }
  }
  return border;
}

Error no_surface() {
  return {Errc::PoorGeometry,
          "the points form no surface of a face's size: look straight into the cameras and try again"};
}

double area_mm2(std::span<const Vec3f> vertices, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += triangle_area(vertices, t);
  return sum;
}

void keep_one_surface(std::span<const Vec3f> vertices, std::pmr::vector<Triangle>& triangles,
                      const CleanerOptions& options, std::pmr::memory_resource* scratch) {
  if (triangles.empty()) return;
  Soup soup(vertices, triangles, scratch);
  soup.keep_largest_component();
  bool torn = false;  // since the largest component was told
  for (int pass = 0; pass < options.ear_passes && soup.drop_ears() > 0; ++pass) torn = true;
  // Every turn but the first takes at least one triangle, so it ends.
  while (soup.split_bow_ties() > 0 || torn) {
    soup.keep_largest_component();
    torn = false;
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (soup.alive(t)) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

void compute_normals(FaceMesh& face, int passes, std::pmr::memory_resource* scratch) {
  face.normals.assign(face.vertices_mm.size(), Vec3f{});
  for (const Triangle& t : face.triangles) {
    const Vec3f n = area_normal(face.vertices_mm, t);
    for (const std::uint32_t v : t) face.normals[v] = plus(face.normals[v], n);
  }
  for (Vec3f& n : face.normals) n = unit(n);
  if (passes <= 0) return;
  std::pmr::vector<Vec3f> next(face.normals.size(), Vec3f{}, scratch);
  for (int pass = 0; pass < passes; ++pass) {
    std::ranges::fill(next, Vec3f{});
    for (const Triangle& t : face.triangles) {
      const Vec3f sum = plus(plus(face.normals[t[0]], face.normals[t[1]]), face.normals[t[2]]);
      for (const std::uint32_t v : t) next[v] = plus(next[v], sum);
    }
    for (std::size_t v = 0; v < next.size(); ++v) face.normals[v] = unit(next[v]);
  }
}

void turn_sigma_perpendicular(FaceMesh& face) {
  for (std::size_t v = 0; v < face.vertices_mm.size(); ++v)
    face.sigma_mm[v] *= std::abs(dot(face.normals[v], unit(face.vertices_mm[v])));
}

}  // namespace relievo::pipeline
