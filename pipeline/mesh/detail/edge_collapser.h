// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplifies a surface by collapsing edges, each vertex onto a neighbour, cheapest first by quadric error
// (Garland, Heckbert 1997), in passes of collapses that do not touch. A border vertex moves only along
// the border and keeps its line (planes across it). No collapse makes the surface anything but one
// manifold, folds a triangle over, or leaves one with an angle below a bar where it had none.
// Deterministic. Thread: any.
//
// Debian's meshoptimizer (0.18) was tried first: of a lattice's points in rows it makes triangles without
// area and edges of three triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {

// Shrinks `triangles`, one manifold surface, to at most `most`, or as far as it can; vertices may be left
// without any. Those that are `fixed` (one byte a vertex, or empty) keep all their triangles' corners.
// Throws std::bad_alloc when `memory` is used up.
void collapse_edges(std::span<const Vec3f> vertices_mm, std::pmr::vector<Triangle>& triangles,
                    std::size_t most, std::span<const std::uint8_t> fixed, std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
