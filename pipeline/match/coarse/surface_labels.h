// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surfaces of a field of disparities: neighbours on the lattice whose disparities differ by little belong
// together. And the holes they enclose. Memory: scratch. Thread: any.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "pipeline/match/coarse/semi_global.h"
#include "pipeline/match/image/plane.h"

namespace relievo::pipeline {

// How large each is, nodes.
struct Surfaces {
  explicit Surfaces(std::pmr::memory_resource* memory) : sizes(memory) {}
  std::pmr::vector<int> sizes;  // [label - 1]
  int largest = 0;              // its label; 0: there is none
  int size_of(int label) const { return label > 0 ? sizes[static_cast<std::size_t>(label - 1)] : 0; }
};

// Fills `label` (0: none) where `allowed` and something is known; neighbours further apart than `step` part
// surfaces.
Surfaces label_surfaces(const Plane<float>& d, const Plane<std::uint8_t>& allowed, float step,
                        Plane<int>& label, std::pmr::memory_resource& scratch);

// Holes that the surface encloses are bridged smoothly, so that refinement can look there: highlights
// and plain skin fail the cross-check and may still be found from their surroundings. What the finer
// pictures do not confirm keeps a large sigma and goes; what is hidden from the right view breaks the
// uniqueness rule and goes.
// `usable`: where a hole may lie; `largest`: nodes it may have.
void bridge_holes(const Plane<std::uint8_t>& usable, int largest, Plane<std::uint8_t>& domain,
                  Plane<float>& disparity, std::pmr::memory_resource& scratch);

}  // namespace relievo::pipeline
