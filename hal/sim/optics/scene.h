// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scene: what the simulated cameras look at. World frame and units: rig.h. Light is linear, 1 is
// the white of a fully lit, perfectly white surface.
// Thread: any number at once, once built.
#pragma once

#include <cstdint>

#include "hal/sim/base/vec3.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {

struct RayHit {
  Vec3 light;              // linear red, green, blue
  double distance_mm = 0;  // to what was met; RayCaster::kFar for the background
  std::int32_t body = -1;  // changes where the picture needs more samples
  bool fine = false;       // hair: thinner than a pixel
};

struct SolidPoint {
  Vec3 point, normal;  // the true surface, without the fine relief of its shading
  bool skin = false;   // face skin: what a reconstruction is judged on
};

class Scene {
 public:
  virtual ~Scene() = default;
  virtual RayHit look(Vec3 origin, Vec3 direction) const = 0;
  virtual bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const = 0;
  virtual bool blocked(Vec3 from, Vec3 direction, double far_mm) const = 0;
  virtual Mesh solid_mesh() const { return {}; }  // in world, for head.ply
};

}  // namespace relievo::hal::sim
