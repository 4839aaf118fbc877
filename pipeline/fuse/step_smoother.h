// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where one pose's surface ends and another one's, or what was completed, goes on, both may lie a fraction of
// a millimetre apart: a step that nobody's skin has. Around such steps the surface is laid anew as a thin
// plate that goes on from both sides.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/mesh/surface_cleaner.h"

namespace relievo::pipeline {

inline constexpr std::uint8_t kBetweenNothing = 255;  // label of a vertex beside which no step is looked for

// `label`, one a vertex: who says where it lies. Steps are triangles between labels that stand at more than
// 40 degrees to the surface beside them; vertices with `stays` 1 are left. Returns by how much each vertex
// moved, millimetres. Memory: `memory`, and the heap for what is laid anew. Thread: any; throws
// std::bad_alloc.
std::pmr::vector<float> smooth_steps(std::span<Vec3f> vertices_mm, std::span<const Triangle> triangles,
                                     std::span<const std::uint8_t> label, std::span<const std::uint8_t> stays,
                                     std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
