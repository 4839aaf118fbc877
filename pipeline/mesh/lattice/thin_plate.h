// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Thin plate: gives free places of a grid the values that bend least between the known ones, so that a closed
// gap continues the curvature on its sides and a hole on a cheek does not become a dimple. The energy is the
// sum of squared second differences (xx, yy and twice xy) over known and free places; where free places lie
// at the edge of what is known it is linear there (natural boundary). Where `like` says another surface's
// values, the plate is bent as that one is, and over more than a length of its own it runs beside it: a
// tension (squared first differences) keeps it from leaving, as a tilt at one rim alone would have it. Least
// squares by conjugate gradients (CGLS; Hestenes, Stiefel 1952; Terzopoulos 1988 for the energy), from a
// coarse grid to the finest: far from what is known, fine steps alone would take thousands. Thread: any;
// deterministic.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>

#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct PlateGrid {
  int columns = 0, rows = 0;
  float height_to_width = 1;  // of a cell
  double tension = 0;         // a cell's width in that length
  double bow = 0;             // what a second difference over a cell's width is where nothing says otherwise
};

// Sets `value` at the `free` places, which must be joined to known ones through neighbours; `known` has one
// byte a place. A free place is none of the known. `like`: empty, or one a place, 0 where nothing is known of
// it. Throws std::bad_alloc when `memory` is used up.
void relax_thin_plate(std::span<double> value, const PlateGrid& grid, std::span<const std::uint32_t> free,
                      std::span<const std::uint8_t> known, std::span<const double> like,
                      std::pmr::memory_resource* memory);

}  // namespace relievo::pipeline
