// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/sliver_mender.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

using Ring = CornerIndex::Ring;

constexpr float kBarDeg = 12;           // no triangle gets a smaller angle unless it had one
constexpr float kMostTurn = 0.7F;       // cosine of how far a triangle may turn in one collapse
constexpr double kBorderWeight = 4;     // of the planes across the border, against the surface's own
constexpr float kLengthWeight = 1e-6F;  // of an edge's squared length: what is flat is thinned evenly
constexpr std::size_t kTriedShare = 3;  // a pass tries the cheapest third of the edges

// The sum of squared distances to planes, weighted by area, as a function of a point.
struct Quadric {
  std::array<double, 11> of{};  // xx, xy, xz, yy, yz, zz, x, y, z, 1, and the weights'

  void add_plane(const Vec3d& n, double offset, double w) {
    const Vec3d a = times(n, w);
    add({{a.x * n.x, a.x * n.y, a.x * n.z, a.y * n.y, a.y * n.z, a.z * n.z, a.x * offset, a.y * offset,
          a.z * offset, w * offset * offset, w}});
  }
  void add(const Quadric& o) {
    for (std::size_t k = 0; k < of.size(); ++k) of[k] += o.of[k];
  }
  double weight() const { return of.back(); }
  double at(const Vec3d& p) const {
    const auto& [xx, xy, xz, yy, yz, zz, x, y, z, one, weight] = of;
    return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + x)) + p.y * (yy * p.y + 2 * (yz * p.z + y)) +
           p.z * (zz * p.z + 2 * z) + one;
  }
};

struct Candidate {
  float cost;
  std::uint32_t gone, kept;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.gone != b.gone ? a.gone < b.gone : a.kept < b.kept;
  }
};

class Collapser {
 public:
  Collapser(std::span<const Vec3f> vertices, std::pmr::vector<Triangle>& triangles,
            std::span<const std::uint8_t> fixed, std::pmr::memory_resource* memory)
      : vertices_(vertices), triangles_(triangles), fixed_(fixed), memory_(memory) {
    candidates_.reserve(3 * triangles.size());
    for (const Vec3f& v : vertices) {
      middle_.x += double(v.x) / double(vertices.size());
      middle_.y += double(v.y) / double(vertices.size());
      middle_.z += double(v.z) / double(vertices.size());
    }
  }

  void collapse(std::size_t most) {
    index_.build(fixed_);
    add_quadrics();
    while (triangles_.size() > most) {
      list_candidates();
      if (run_pass(triangles_.size() - most) == 0) return;
      index_.build(fixed_);
    }
  }

 private:
  // Near the origin, so that squares keep their digits.
  Vec3d at(std::uint32_t v) const { return minus(wide(vertices_[v]), middle_); }

  void add_quadrics() {
    for (const Triangle& t : triangles_) {
      const Vec3d a = at(t[0]);
      Vec3d n = cross(minus(at(t[1]), a), minus(at(t[2]), a));
      const double twice_area = std::sqrt(dot(n, n));
      if (!(twice_area > 0)) continue;
      n = {n.x / twice_area, n.y / twice_area, n.z / twice_area};
      for (const std::uint32_t v : t) quadrics_[v].add_plane(n, -dot(n, a), twice_area / 6);
      for (std::size_t k = 0; k < 3; ++k)
        if (index_.across(t[k], t[(k + 1) % 3]) == kGoneVertex) add_border(t[k], t[(k + 1) % 3], n);
    }
  }

  // A plane through the border's edge, upright on the surface.
  void add_border(std::uint32_t from, std::uint32_t to, const Vec3d& surface_normal) {
    const Vec3d along = minus(at(to), at(from));
    Vec3d n = cross(along, surface_normal);
    const double l = std::sqrt(dot(n, n));
    if (!(l > 0)) return;
    n = {n.x / l, n.y / l, n.z / l};
    for (const std::uint32_t v : {from, to})
      quadrics_[v].add_plane(n, -dot(n, at(from)), kBorderWeight * dot(along, along));
  }

  float cost(std::uint32_t gone, std::uint32_t kept) const {
    Quadric sum = quadrics_[gone];
    sum.add(quadrics_[kept]);
    const double square = std::max(sum.at(at(kept)), 0.0) / std::max(sum.weight(), 1e-12);
    return float(square) + kLengthWeight * squared_distance(vertices_[gone], vertices_[kept]);
  }

  // Each edge once, in its cheaper direction.
  void list_candidates() {
    std::ranges::fill(border_, std::uint8_t{0});
    for (const Triangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k)
        if (index_.across(t[k], t[(k + 1) % 3]) == kGoneVertex) border_[t[k]] = border_[t[(k + 1) % 3]] = 1;
    candidates_.clear();
    for (const Triangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (index_.touched(a) || index_.touched(b)) continue;  // fixed
        const bool open = index_.across(a, b) == kGoneVertex;
        if (!open && a > b) continue;  // the other triangle's turn
        if (border_[a] && border_[b] && !open) continue;
        Candidate best{cost(a, b), a, b};
        if (!border_[b] || open) best = std::min(best, Candidate{cost(b, a), b, a});
        if (border_[a] && !open) best = {cost(b, a), b, a};
        candidates_.push_back(best);
      }
  }

  std::size_t run_pass(std::size_t wanted) {
    const std::size_t tried =
        std::min(candidates_.size(), std::max(candidates_.size() / kTriedShare, std::size_t{100}));
    std::nth_element(candidates_.begin(),
                     candidates_.begin() + std::ptrdiff_t(tried == candidates_.size() ? 0 : tried),
                     candidates_.end());
    std::sort(candidates_.begin(), candidates_.begin() + std::ptrdiff_t(tried));
    const std::size_t cheap = run(0, tried, wanted);
    if (cheap > 0) return cheap;
    std::sort(candidates_.begin() + std::ptrdiff_t(tried), candidates_.end());
    return run(tried, candidates_.size(), wanted);
  }

  std::size_t run(std::size_t from, std::size_t to, std::size_t wanted) {
    std::size_t gone = 0;
    for (std::size_t i = from; i < to && gone < wanted; ++i) {
      const Candidate& c = candidates_[i];
      const Ring of_gone = index_.ring(c.gone), of_kept = index_.ring(c.kept);
      if (!index_.may_collapse(of_gone, of_kept, c.gone, c.kept) || !keeps_shape(of_gone, c.gone, c.kept))
        continue;
      gone += border_[c.gone] ? 1 : 2;
      index_.collapse(of_gone, c.gone, c.kept);
      quadrics_[c.kept].add(quadrics_[c.gone]);
    }
    return gone;
  }

  bool keeps_shape(const Ring& ring, std::uint32_t gone, std::uint32_t kept) const {
    for (const std::uint32_t t : ring) {
      const Triangle& before = triangles_[t];
      if (holds(before, kept)) continue;
      Triangle after = before;
      std::ranges::replace(after, gone, kept);
      const Vec3f n = area_normal(vertices_, before), m = area_normal(vertices_, after);
      if (!(dot(n, m) > kMostTurn * length(n) * length(m))) return false;
      const float angle = smallest(after);
      if (angle < kBarDeg && angle < smallest(before)) return false;
    }
    return true;
  }

  float smallest(const Triangle& t) const {
    return smallest_angle_deg(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
  }

  std::span<const Vec3f> vertices_;
  std::pmr::vector<Triangle>& triangles_;
  std::span<const std::uint8_t> fixed_;
  std::pmr::memory_resource* memory_;
  CornerIndex index_{vertices_.size(), triangles_, memory_};
  std::pmr::vector<Quadric> quadrics_{vertices_.size(), Quadric{}, memory_};
  std::pmr::vector<std::uint8_t> border_{vertices_.size(), 0, memory_};
  std::pmr::vector<Candidate> candidates_{memory_};
  Vec3d middle_;
};

}  // namespace

void collapse_edges(std::span<const Vec3f> vertices, std::pmr::vector<Triangle>& triangles, std::size_t most,
                    std::span<const std::uint8_t> fixed, std::pmr::memory_resource* memory) {
  if (triangles.empty()) return;
  Collapser(vertices, triangles, fixed, memory).collapse(most);
}

}  // namespace relievo::pipeline
