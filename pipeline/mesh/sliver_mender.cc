// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/sliver_mender.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/mesh/vector_math.h"

namespace relievo::pipeline {
namespace {

using mesh::cross, mesh::dot, mesh::length, mesh::minus;

constexpr std::uint32_t kNone = 0xFFFFFFFFU;
constexpr std::size_t kMostAround = 24;   // a vertex of more triangles is left alone
constexpr int kMostPasses = 8;

// Triangles around a vertex, a few.
struct Ring {
  std::array<std::uint32_t, kMostAround> at{};
  std::size_t count = 0;
};

class Mender {
 public:
  Mender(std::span<const Vec3f> vertices, std::pmr::vector<Triangle>& triangles, const SliverLimits& limits, std::pmr::memory_resource* memory)
      : vertices_(vertices), triangles_(triangles), bar_(limits.smallest_angle_deg),
        cosine_of_bar_(std::cos(bar_ * std::numbers::pi_v<float> / 180)), min_cosine_(cosine_of_slope(limits.max_slope)),
        first_(vertices.size() + 1, 0U, memory), around_(3 * triangles.size(), 0U, memory), touched_(vertices.size(), 0, memory),
        slivers_(memory) {
    slivers_.reserve(triangles.size());
    find_slivers();
  }

  std::size_t mend() {
    for (int pass = 0; pass < kMostPasses && !slivers_.empty(); ++pass) {
      index_corners();
      std::fill(touched_.begin(), touched_.end(), std::uint8_t{0});
      std::size_t mended = 0;
      for (const std::uint32_t t : slivers_) mended += mend(t);
      std::erase_if(triangles_, [](const Triangle& t) { return t[0] == kNone; });
      find_slivers();
      if (mended == 0) break;
    }
    if (!slivers_.empty()) drop_on_border();
    return slivers_.size();
  }

 private:
  float angle(const Triangle& t) const { return smallest_angle_deg(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]); }

  void find_slivers() {
    slivers_.clear();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (is_sliver(triangles_[t])) slivers_.push_back(t);
  }

  // The smallest angle lies opposite the shortest edge (law of cosines, without a root).
  bool is_sliver(const Triangle& t) const {
    float a = mesh::squared_distance(vertices_[t[0]], vertices_[t[1]]);
    float b = mesh::squared_distance(vertices_[t[1]], vertices_[t[2]]);
    float c = mesh::squared_distance(vertices_[t[2]], vertices_[t[0]]);
    if (a < c) std::swap(a, c);
    if (b < c) std::swap(b, c);
    const float twice = a + b - c;
    return twice * twice > 4 * a * b * cosine_of_bar_ * cosine_of_bar_;
  }

  void index_corners() {
    std::fill(first_.begin(), first_.end(), 0U);
    for (const Triangle& t : triangles_)
      for (const std::uint32_t v : t) ++first_[v + 1];
    for (std::size_t v = 0; v < vertices_.size(); ++v) first_[v + 1] += first_[v];
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t v : triangles_[t]) around_[first_[v]++] = t;
    std::copy_backward(first_.begin(), first_.end() - 1, first_.end());
    first_[0] = 0;
  }

  // Each pass changes a neighbourhood once: the index knows it as it was.
  bool mend(std::uint32_t t) {
    const Triangle& corners = triangles_[t];
    for (const std::uint32_t v : corners)
      if (v == kNone || touched_[v]) return false;
    std::array<std::size_t, 3> by_length{0, 1, 2};  // edge k runs from corner k to the next
    const auto squared = [&](std::size_t k) { return mesh::squared_distance(vertices_[corners[k]], vertices_[corners[(k + 1) % 3]]); };
    std::sort(by_length.begin(), by_length.end(), [&](std::size_t i, std::size_t j) { return squared(i) < squared(j); });
    return flip(t, by_length[2]) || collapse(t, by_length[0]) || drop(t, by_length[2]) || collapse(t, by_length[1]) || drop(t, by_length[1]) || drop(t, by_length[0]);
  }

  // What nothing helps goes, where that opens no hole.
  void drop_on_border() {
    index_corners();
    const auto hopeless = [this](std::uint32_t t) {
      const Triangle& corners = triangles_[t];
      return std::any_of(corners.begin(), corners.end(), [this](std::uint32_t v) { return on_border(v); });
    };
    const auto first_kept = std::partition(slivers_.begin(), slivers_.end(), hopeless);
    for (auto t = slivers_.begin(); t != first_kept; ++t) triangles_[*t].fill(kNone);
    std::erase_if(triangles_, [](const Triangle& t) { return t[0] == kNone; });
  }

  bool flip(std::uint32_t t, std::size_t k) {
    const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3], c = triangles_[t][(k + 2) % 3];
    const std::uint32_t other = across(a, b);
    if (other == kNone) return false;
    const std::uint32_t d = third(triangles_[other], a, b);
    if (touched_[d] || joined(c, d)) return false;
    const Triangle one{a, d, c}, two{d, b, c};
    const float before = std::min(angle(triangles_[t]), angle(triangles_[other]));
    if (!stands(one) || !stands(two) || !(std::min(angle(one), angle(two)) > before)) return false;
    triangles_[t] = one;
    triangles_[other] = two;
    for (const std::uint32_t v : {a, b, c, d}) touch(v);
    return true;
  }

  bool collapse(std::uint32_t t, std::size_t k) {
    const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
    const float worst = angle(triangles_[t]);
    return collapse_onto(a, b, worst) || collapse_onto(b, a, worst);
  }

  // All that changes must be better than the sliver. Where both lie on the border, the edge between them
  // must, too: the border stays where it is.
  bool collapse_onto(std::uint32_t kept, std::uint32_t gone, float worst) {
    const Ring of_kept = ring(kept), of_gone = ring(gone);
    if (of_kept.count == 0 || of_gone.count == 0) return false;
    const bool border_edge = across(kept, gone) == kNone || across(gone, kept) == kNone;
    if (on_border(gone) && !(border_edge && on_border(kept))) return false;
    if (common_neighbours(of_kept, of_gone, kept, gone) != (border_edge ? 1U : 2U)) return false;
    for (std::size_t i = 0; i < of_gone.count; ++i) {
      Triangle moved = triangles_[of_gone.at[i]];
      if (holds(moved, kept)) continue;
      std::replace(moved.begin(), moved.end(), gone, kept);
      if (!stands(moved) || angle(moved) <= worst) return false;
    }
    for (std::size_t i = 0; i < of_gone.count; ++i) {
      Triangle& moved = triangles_[of_gone.at[i]];
      for (const std::uint32_t v : moved) touch(v);
      if (holds(moved, kept)) moved.fill(kNone);
      else std::replace(moved.begin(), moved.end(), gone, kept);
    }
    return true;
  }

  // A triangle on the border by edge k, its tip inside; or one that hangs on by one edge.
  bool drop(std::uint32_t t, std::size_t k) {
    const Triangle corners = triangles_[t];
    int edges = 0;
    for (std::size_t i = 0; i < 3; ++i) edges += across(corners[i], corners[(i + 1) % 3]) != kNone;
    const bool inwards = across(corners[k], corners[(k + 1) % 3]) == kNone && !on_border(corners[(k + 2) % 3]);
    if (edges != 1 && !(edges == 2 && inwards)) return false;
    triangles_[t].fill(kNone);
    for (const std::uint32_t v : corners) touch(v);
    return true;
  }

  // What changes around a vertex changes the rings of its neighbours.
  void touch(std::uint32_t v) { touched_[v] = 1; }

  bool stands(const Triangle& t) const { return facing(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]], min_cosine_); }
  static bool holds(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }
  static std::uint32_t third(const Triangle& t, std::uint32_t a, std::uint32_t b) {
    return t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
  }

  // Empty where a triangle has gone or there are too many.
  Ring ring(std::uint32_t v) const {
    Ring result;
    if (touched_[v] || first_[v + 1] - first_[v] > kMostAround) return result;
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
      const Triangle& t = triangles_[around_[i]];
      if (!holds(t, v)) return {};
      result.at[result.count++] = around_[i];
    }
    return result;
  }

  // The triangle on the other side of the edge a to b, in which it runs from b to a.
  std::uint32_t across(std::uint32_t a, std::uint32_t b) const {
    for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i) {
      const Triangle& t = triangles_[around_[i]];
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] == b && t[(k + 1) % 3] == a) return around_[i];
    }
    return kNone;
  }

  bool joined(std::uint32_t a, std::uint32_t b) const { return across(a, b) != kNone || across(b, a) != kNone; }

  bool on_border(std::uint32_t v) const {
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i)
      for (const std::uint32_t n : triangles_[around_[i]])
        if (n != v && (across(v, n) == kNone || across(n, v) == kNone)) return true;
    return false;
  }

  std::size_t common_neighbours(const Ring& of_a, const Ring& of_b, std::uint32_t a, std::uint32_t b) const {
    std::array<std::uint32_t, 2 * kMostAround> near{};
    std::size_t count = 0, common = 0;
    for (std::size_t i = 0; i < of_a.count; ++i)
      for (const std::uint32_t v : triangles_[of_a.at[i]])
        if (v != a && v != b && std::find(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), v) == near.begin() + static_cast<std::ptrdiff_t>(count)) near[count++] = v;
    for (std::size_t n = 0; n < count; ++n)
      for (std::size_t i = 0; i < of_b.count; ++i)
        if (holds(triangles_[of_b.at[i]], near[n])) {
          ++common;
          break;
        }
    return common;
  }

  std::span<const Vec3f> vertices_;
  std::pmr::vector<Triangle>& triangles_;
  float bar_, cosine_of_bar_, min_cosine_;
  std::pmr::vector<std::uint32_t> first_, around_;  // triangles around vertex v: around_[first_[v] .. first_[v + 1])
  std::pmr::vector<std::uint8_t> touched_;
  std::pmr::vector<std::uint32_t> slivers_;
};

}  // namespace

float smallest_angle_deg(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const auto at = [](const Vec3f& p, const Vec3f& q, const Vec3f& r) {
    return std::atan2(length(cross(minus(q, p), minus(r, p))), dot(minus(q, p), minus(r, p)));
  };
  return std::min({at(a, b, c), at(b, c, a), at(c, a, b)}) * 180 / std::numbers::pi_v<float>;
}

std::size_t mend_slivers(std::span<const Vec3f> vertices, std::pmr::vector<Triangle>& triangles, const SliverLimits& limits,
                         std::pmr::memory_resource* scratch) {
  return Mender(vertices, triangles, limits, scratch).mend();
}

}  // namespace relievo::pipeline
