// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A random speckle as artefacts for passive stereo carry it: dark dots on matt white, in three sizes,
// so that small pictures of it still have something to match. A field over space: where a surface cuts it
// the dots lie on the surface without seams.
// Thread: any.
#pragma once

#include <cstdint>

#include "hal/sim/base/vec3.h"

namespace relievo::hal::sim {

double speckle(Vec3 p_mm, std::uint32_t seed);  // reflectance, 0.06 .. 0.8

// How bright a matt surface stands there: two soft panels beside the cameras and the room's own light.
double matt_light(Vec3 p_mm, Vec3 normal);  // in world; times reflectance

// What is behind an artefact.
Vec3 dark_room(Vec3 direction);

}  // namespace relievo::hal::sim
