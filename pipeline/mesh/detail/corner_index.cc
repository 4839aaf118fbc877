// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/corner_index.h"

#include <algorithm>

namespace relievo::pipeline {

CornerIndex::CornerIndex(std::size_t vertices, std::pmr::vector<Corners>& triangles,
                         std::pmr::memory_resource* memory)
    : triangles_(triangles), around_(memory), touched_(vertices, 0, memory) {}

void CornerIndex::build(std::span<const std::uint8_t> fixed) {
  std::erase_if(triangles_, [](const Corners& t) { return t[0] == kGoneVertex; });
  if (fixed.empty()) std::ranges::fill(touched_, std::uint8_t{0});
  else std::ranges::copy(fixed, touched_.begin());
  around_.sort(touched_.size(), [this](auto&& add) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t v : triangles_[t]) add(v, t);
  });
}

CornerIndex::Ring CornerIndex::ring(std::uint32_t v) const {
  Ring result;
  if (touched_[v] || around_[v].size() > kMostAround) return result;
  for (const std::uint32_t t : around_[v]) result.at[result.count++] = t;
  return result;
}

std::uint32_t CornerIndex::across(std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t of_b : around_[b]) {
    const Corners& t = triangles_[of_b];
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
  if (of_gone.count == 0 || of_kept.count == 0) return false;
  const bool border = border_edge(gone, kept);
  if (on_border(gone) && !(border && on_border(kept))) return false;
  return common_neighbours(of_kept, of_gone, kept, gone) == (border ? 1U : 2U);
}

void CornerIndex::collapse(const Ring& of_gone, std::uint32_t gone, std::uint32_t kept) {
  for (std::size_t i = 0; i < of_gone.count; ++i) {
    Corners& moved = triangles_[of_gone.at[i]];
    for (const std::uint32_t v : moved) touch(v);
    if (holds(moved, kept)) moved.fill(kGoneVertex);
    else std::ranges::replace(moved, gone, kept);
  }
}

std::size_t CornerIndex::common_neighbours(const Ring& of_a, const Ring& of_b, std::uint32_t a,
                                           std::uint32_t b) const {
  std::array<std::uint32_t, 2 * kMostAround> near{};
  auto end = near.begin();
  for (std::size_t i = 0; i < of_a.count; ++i)
    for (const std::uint32_t v : triangles_[of_a.at[i]])
      if (v != a && v != b && std::find(near.begin(), end, v) == end) *end++ = v;
  std::size_t common = 0;
  for (auto n = near.begin(); n != end; ++n)
    for (std::size_t i = 0; i < of_b.count; ++i)
      if (holds(triangles_[of_b.at[i]], *n)) {
        ++common;
        break;
      }
  return common;
}

}  // namespace relievo::pipeline
