// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where hair grows and how it lies: scalp, brows, lashes. Head frame, mm.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/sim/head/shape/head_field.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {

struct HairStyle {
  Strands strands;
  std::vector<float> tint;   // per node of the strands: 1 is the person's hair colour
  std::vector<float> along;  // per node: 0 root, 1 tip
};

// 0 bare .. 1 full; at head points.
double scalp_hair(const HeadTraits& traits, Vec3 p);
double brow_hair(const HeadField& field, Vec3 p);
double beard_area(const HeadTraits& traits, Vec3 p);

HairStyle grow_hair(const HeadField& field, const Mesh& skin, const std::vector<Vec3>& normals);

}  // namespace relievo::hal::sim
