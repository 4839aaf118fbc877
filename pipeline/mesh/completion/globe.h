// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Globe: nodes spread evenly over a sphere, an icosahedron whose triangles are quartered again and again.
// Values at its nodes stay smooth when it is refined (Loop, Smooth subdivision surfaces based on triangles,
// 1987). Memory: the resource given. Throws std::bad_alloc. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct Globe {
  // Quartered `times` times: 10 * 4^times + 2 nodes.
  Globe(int times, std::pmr::memory_resource* memory);

  // Quarters every triangle; new nodes follow. Each of `fields` has one value a node and gets as many as
  // there are then. The directions are smoothed as the fields are, or these would show the icosahedron's
  // edges as folds; without fields the nodes keep their places.
  void quarter(std::span<std::pmr::vector<double>> fields);

  std::pmr::vector<Vec3d> direction;                         // unit length; the first looks along -z
  std::pmr::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise from outside
};

}  // namespace relievo::pipeline
