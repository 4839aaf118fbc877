// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/sliver_mender.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

CornerIndex::CornerIndex(std::size_t vertices, std::pmr::vector<Triangle>& triangles,
                         std::pmr::memory_resource* memory)
    : triangles_(triangles), around_(memory), touched_(vertices, 0, memory) {}

void CornerIndex::build(std::span<const std::uint8_t> fixed) {
  std::erase_if(triangles_, [](const Triangle& t) { return t[0] == kGoneVertex; });
  if (fixed.empty()) std::ranges::fill(touched_, std::uint8_t{0});
  else std::ranges::copy(fixed, touched_.begin());
  group_around(around_, touched_.size(), triangles_);
}

std::uint32_t CornerIndex::across(std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t of_b : around_[b]) {
    const Triangle& t = triangles_[of_b];
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] == b && t[(k + 1) % 3] == a) return of_b;
  }
  return kGoneVertex;
}

bool CornerIndex::on_border(std::uint32_t v) const {
  for (const std::uint32_t t : around_[v])
    for (const std::uint32_t n : triangles_[t])
      if (n != v && border_edge(v, n)) return true;
  return false;
}

bool CornerIndex::may_collapse(const Ring& of_gone, const Ring& of_kept, std::uint32_t gone,
                               std::uint32_t kept) const {
  if (of_gone.empty() || of_kept.empty()) return false;
  const bool border = border_edge(gone, kept);
  if (on_border(gone) && !(border && on_border(kept))) return false;
  // The neighbours of both.
  std::array<std::uint32_t, 2 * kMostAround> near{};
  auto end = near.begin();
  for (const std::uint32_t t : of_kept)
    for (const std::uint32_t v : triangles_[t])
      if (v != kept && v != gone && std::find(near.begin(), end, v) == end) *end++ = v;
  return std::count_if(near.begin(), end, [&](std::uint32_t n) {
           return std::ranges::any_of(of_gone, [&](std::uint32_t t) { return holds(triangles_[t], n); });
         }) == (border ? 1 : 2);
}

void CornerIndex::collapse(const Ring& of_gone, std::uint32_t gone, std::uint32_t kept) {
  for (const std::uint32_t t : of_gone) {
    Triangle& moved = triangles_[t];
    for (const std::uint32_t v : moved) touch(v);
    if (holds(moved, kept)) moved.fill(kGoneVertex);
    else std::ranges::replace(moved, gone, kept);
  }
}

namespace {

constexpr int kMostPasses = 8;

using Ring = CornerIndex::Ring;

class Mender {
 public:
  Mender(std::span<const Vec3f> vertices, std::pmr::vector<Triangle>& triangles, float max_slope,
         std::pmr::memory_resource* memory)
      : vertices_(vertices), triangles_(triangles), max_slope_(max_slope), memory_(memory) {
    slivers_.reserve(triangles.size());
    find_slivers();
  }

  std::size_t mend() {
    for (int pass = 0; pass < kMostPasses && !slivers_.empty(); ++pass) {
      index_.build();
      std::size_t mended = 0;
      for (const std::uint32_t t : slivers_) mended += mend(t);
      std::erase_if(triangles_, [](const Triangle& t) { return t[0] == kGoneVertex; });
      find_slivers();
      if (mended == 0) break;
    }
    if (!slivers_.empty()) drop_on_border();
    return slivers_.size();
  }

 private:
  float angle(const Triangle& t) const {
    return smallest_angle_deg(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
  }

  void find_slivers() {
    slivers_.clear();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (is_sliver(triangles_[t])) slivers_.push_back(t);
  }

  // The smallest angle lies opposite the shortest edge (law of cosines, without a root).
  bool is_sliver(const Triangle& t) const {
    float a = squared_distance(vertices_[t[0]], vertices_[t[1]]);
    float b = squared_distance(vertices_[t[1]], vertices_[t[2]]);
    float c = squared_distance(vertices_[t[2]], vertices_[t[0]]);
    if (a < c) std::swap(a, c);
    if (b < c) std::swap(b, c);
    const float twice = a + b - c;
    return twice * twice > 4 * a * b * cosine_of_bar_ * cosine_of_bar_;
  }

  // Each pass changes a neighbourhood once: the index knows it as it was.
  bool mend(std::uint32_t t) {
    const Triangle& corners = triangles_[t];
    for (const std::uint32_t v : corners)
      if (v == kGoneVertex || index_.touched(v)) return false;
    std::array<std::size_t, 3> by_length{0, 1, 2};  // edge k runs from corner k to the next
    const auto squared = [&](std::size_t k) {
      return squared_distance(vertices_[corners[k]], vertices_[corners[(k + 1) % 3]]);
    };
    std::ranges::sort(by_length, [&](std::size_t i, std::size_t j) { return squared(i) < squared(j); });
    return flip(t, by_length[2]) || collapse(t, by_length[0]) || drop(t, by_length[2]) ||
           collapse(t, by_length[1]) || drop(t, by_length[1]) || drop(t, by_length[0]) || take_corner_out(t);
  }

  // What nothing helps goes, where that opens no hole.
  void drop_on_border() {
    index_.build();
    const auto hopeless = [this](std::uint32_t t) {
      const Triangle& corners = triangles_[t];
      return std::ranges::any_of(corners, [this](std::uint32_t v) { return index_.on_border(v); });
    };
    const auto first_kept = std::partition(slivers_.begin(), slivers_.end(), hopeless);
    for (auto t = slivers_.begin(); t != first_kept; ++t) triangles_[*t].fill(kGoneVertex);
    std::erase_if(triangles_, [](const Triangle& t) { return t[0] == kGoneVertex; });
  }

  bool flip(std::uint32_t t, std::size_t k) {
    const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3], c = triangles_[t][(k + 2) % 3];
    const std::uint32_t other = index_.across(a, b);
    if (other == kGoneVertex) return false;
    const std::uint32_t d = third(triangles_[other], a, b);
    if (index_.touched(d) || index_.joined(c, d)) return false;
    const Triangle one{a, d, c}, two{d, b, c};
    const float before = std::min(angle(triangles_[t]), angle(triangles_[other]));
    if (!stands(one) || !stands(two) || !(std::min(angle(one), angle(two)) > before)) return false;
    triangles_[t] = one;
    triangles_[other] = two;
    for (const std::uint32_t v : {a, b, c, d}) index_.touch(v);
    return true;
  }

  bool collapse(std::uint32_t t, std::size_t k) {
    const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
    const float worst = angle(triangles_[t]);
    return collapse_onto(a, b, worst) || collapse_onto(b, a, worst);
  }

  // Any corner onto any of its neighbours.
  bool take_corner_out(std::uint32_t t) {
    const Triangle corners = triangles_[t];
    const float worst = angle(corners);
    for (const std::uint32_t gone : corners) {
      const Ring ring = index_.ring(gone);
      for (const std::uint32_t beside : ring)
        for (const std::uint32_t kept : Triangle(triangles_[beside]))
          if (kept != gone && collapse_onto(kept, gone, worst)) return true;
    }
    return false;
  }

  // All that changes must be better than the sliver. Where both lie on the border, the edge between them
  // must, too: the border stays where it is.
  bool collapse_onto(std::uint32_t kept, std::uint32_t gone, float worst) {
    const Ring of_kept = index_.ring(kept), of_gone = index_.ring(gone);
    if (!index_.may_collapse(of_gone, of_kept, gone, kept)) return false;
    for (const std::uint32_t t : of_gone) {
      Triangle moved = triangles_[t];
      if (holds(moved, kept)) continue;
      std::ranges::replace(moved, gone, kept);
      if (!stands(moved) || angle(moved) <= worst) return false;
    }
    index_.collapse(of_gone, gone, kept);
    return true;
  }

  // A triangle on the border by edge k, its tip inside; or one that hangs on by one edge.
  bool drop(std::uint32_t t, std::size_t k) {
    const Triangle corners = triangles_[t];
    int edges = 0;
    for (std::size_t i = 0; i < 3; ++i)
      edges += index_.across(corners[i], corners[(i + 1) % 3]) != kGoneVertex;
    const bool inwards = index_.across(corners[k], corners[(k + 1) % 3]) == kGoneVertex &&
                         !index_.on_border(corners[(k + 2) % 3]);
    if (edges != 1 && !(edges == 2 && inwards)) return false;
    triangles_[t].fill(kGoneVertex);
    for (const std::uint32_t v : corners) index_.touch(v);
    return true;
  }

  bool stands(const Triangle& t) const {
    return facing(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]], min_cosine_);
  }
  static std::uint32_t third(const Triangle& t, std::uint32_t a, std::uint32_t b) {
    return t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
  }

  std::span<const Vec3f> vertices_;
  std::pmr::vector<Triangle>& triangles_;
  float max_slope_, min_cosine_ = cosine_of_slope(max_slope_);
  float cosine_of_bar_ = std::cos(kSmallestAngleDeg * std::numbers::pi_v<float> / 180);
  std::pmr::memory_resource* memory_;
  CornerIndex index_{vertices_.size(), triangles_, memory_};
  std::pmr::vector<std::uint32_t> slivers_{memory_};
};

}  // namespace

float smallest_angle_deg(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const auto at = [](const Vec3f& p, const Vec3f& q, const Vec3f& r) {
    return std::atan2(length(cross(minus(q, p), minus(r, p))), dot(minus(q, p), minus(r, p)));
  };
  return std::min({at(a, b, c), at(b, c, a), at(c, a, b)}) * 180 / std::numbers::pi_v<float>;
}

std::size_t mend_slivers(std::span<const Vec3f> vertices, std::pmr::vector<Triangle>& triangles,
                         float max_slope, std::pmr::memory_resource* scratch) {
  return Mender(vertices, triangles, max_slope, scratch).mend();
}

}  // namespace relievo::pipeline
