// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CornerIndex: which triangles lie around each vertex, for passes that change a surface in places that do
// not touch: the index knows the triangles as they were when it was built, so whoever changes some marks
// all their corners as touched and leaves touched vertices alone until the next build().
// Triangles whose first corner is kGoneVertex have been taken out. Thread: one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "hal/base/groups.h"

namespace relievo::pipeline {

inline constexpr std::uint32_t kGoneVertex = 0xFFFFFFFFU;

class CornerIndex {
 public:
  using Corners = std::array<std::uint32_t, 3>;
  static constexpr std::size_t kMostAround = 24;  // a vertex of more triangles is left alone

  // Triangles around a vertex, a few.
  struct Ring {
    std::array<std::uint32_t, kMostAround> at{};
    std::size_t count = 0;
  };

  // Looks at `triangles` for as long as it lives; there are never more later. Throws std::bad_alloc.
  CornerIndex(std::size_t vertices, std::pmr::vector<Corners>& triangles, std::pmr::memory_resource* memory);

  // Takes out what is gone, and counts anew. Vertices that are `fixed` (one byte each, or empty) are touched
  // from the start.
  void build(std::span<const std::uint8_t> fixed = {});

  void touch(std::uint32_t v) { touched_[v] = 1; }
  bool touched(std::uint32_t v) const { return touched_[v] != 0; }
  Ring ring(std::uint32_t v) const;  // empty where touched, or too many
  std::uint32_t across(std::uint32_t a,
                       std::uint32_t b) const;  // the triangle that runs from b to a, or kGoneVertex
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
  std::size_t common_neighbours(const Ring& of_a, const Ring& of_b, std::uint32_t a, std::uint32_t b) const;

  std::pmr::vector<Corners>& triangles_;
  Groups around_;  // triangles around each vertex
  std::pmr::vector<std::uint8_t> touched_;
};

inline bool holds(const CornerIndex::Corners& t, std::uint32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

}  // namespace relievo::pipeline
