// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CornerIndex: which triangles lie around each vertex, for passes that change a surface in places that do
// not touch: the index knows the triangles as they were when it was built, so whoever changes some marks
// all their corners as touched and leaves touched vertices alone until the next build().
// Triangles whose first corner is kGoneVertex have been taken out. Thread: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/groups.h"
#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {

inline constexpr std::uint32_t kGoneVertex = 0xFFFFFFFFU;

class CornerIndex {
 public:
  static constexpr std::size_t kMostAround = 24;  // a vertex of more triangles is left alone

  using Ring = std::span<const std::uint32_t>;  // triangles around a vertex, a few

  // Looks at `triangles` for as long as it lives; there are never more later. Throws std::bad_alloc.
  CornerIndex(std::size_t vertices, std::pmr::vector<Triangle>& triangles, std::pmr::memory_resource* memory);

  // Takes out what is gone, and counts anew. Vertices that are `fixed` (one byte each, or empty) are touched
  // from the start.
  void build(std::span<const std::uint8_t> fixed = {});

  void touch(std::uint32_t v) { touched_[v] = 1; }
  bool touched(std::uint32_t v) const { return touched_[v] != 0; }
  // Empty where touched, or too many.
  Ring ring(std::uint32_t v) const {
    return touched_[v] || around_[v].size() > kMostAround ? Ring{} : around_[v];
  }
  // The triangle that runs from b to a, or kGoneVertex.
  std::uint32_t across(std::uint32_t a, std::uint32_t b) const;
  bool joined(std::uint32_t a, std::uint32_t b) const {
    return across(a, b) != kGoneVertex || across(b, a) != kGoneVertex;
  }
  bool border_edge(std::uint32_t a, std::uint32_t b) const {
    return across(a, b) == kGoneVertex || across(b, a) == kGoneVertex;
  }
  bool on_border(std::uint32_t v) const;

  // Whether `gone` may be moved onto its neighbour `kept` and the surface stays one manifold with the same
  // border line (the link condition; Dey et al. 1999): a vertex of the border only along the border.
  bool may_collapse(const Ring& of_gone, const Ring& of_kept, std::uint32_t gone, std::uint32_t kept) const;
  void collapse(const Ring& of_gone, std::uint32_t gone, std::uint32_t kept);

 private:
  std::pmr::vector<Triangle>& triangles_;
  Groups around_;  // triangles around each vertex
  std::pmr::vector<std::uint8_t> touched_;
};

inline bool holds(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

// Takes slivers out of a surface: a triangle with an angle below the bar gives its longest edge to a flip,
// its shortest edge to a collapse, or goes where it hangs on the border by its longest edge (the local
// operations of Freitag, Ollivier-Gooch 1997, without moving any vertex). No change makes a worse angle,
// turns a triangle away from the camera or beyond `max_slope`, makes an edge of three triangles, or adds
// a triangle. Deterministic. Thread: any.

// The angle below which a triangle is a sliver: what the steepest surface that is shown makes of a
// lattice's right-angled triangles (77 degrees: 12.7) stays above it.
inline constexpr float kSmallestAngleDeg = 10;

// `triangles` must be one manifold surface. Vertices may be left without triangles. Returns how many slivers
// nothing helped; those that touched the border are gone, and what they held together may have come apart:
// above 0 the surface must be cleaned again (keep_one_surface). Throws std::bad_alloc when `scratch` is used
// up.
std::size_t mend_slivers(std::span<const Vec3f> vertices_mm, std::pmr::vector<Triangle>& triangles,
                         float max_slope, std::pmr::memory_resource* scratch);

// The smallest of the three angles, degrees.
float smallest_angle_deg(const Vec3f& a, const Vec3f& b, const Vec3f& c);

// Simplifies a surface by collapsing edges, each vertex onto a neighbour, cheapest first by quadric error
// (Garland, Heckbert 1997), in passes of collapses that do not touch. A border vertex moves only along
// the border and keeps its line (planes across it). No collapse makes the surface anything but one
// manifold, folds a triangle over, or leaves one with an angle below a bar where it had none.
// Deterministic. Thread: any.
//
// Debian's meshoptimizer (0.18) was tried first: of a lattice's points in rows it makes triangles without
// area and edges of three triangles.
//
// Shrinks `triangles`, one manifold surface, to at most `most`, or as far as it can; vertices may be left
// without any. Those that are `fixed` (one byte a vertex, or empty) keep all their triangles' corners.
// Throws std::bad_alloc when `memory` is used up.
void collapse_edges(std::span<const Vec3f> vertices_mm, std::pmr::vector<Triangle>& triangles,
                    std::size_t most, std::span<const std::uint8_t> fixed, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
