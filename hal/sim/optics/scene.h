// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scene: what the simulated cameras look at. World frame and units: rig.h. Light is linear, 1 is
// the white of a fully lit, perfectly white surface.
// Thread: any number at once, once built.
#pragma once

#include <array>
#include <cstdint>

#include "hal/base/result.h"
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
  // What is true of it; nothing of a scene that no measurement is judged by.
  virtual bool solid(Vec3 /*origin*/, Vec3 /*direction*/, SolidPoint& /*out*/) const { return false; }
  virtual bool blocked(Vec3 /*from*/, Vec3 /*direction*/, double /*far_mm*/) const { return false; }
  virtual Mesh solid_mesh() const { return {}; }  // in world, for head.ply
};

// The kiosk's light: two soft panels beside the cameras, a weak one below, the screen, and a dim room. World
// frame, mm.
struct Panel {
  Vec3 centre, half_x, half_y;  // a rectangle
  double power = 0;             // on white that faces it from kPanelReferenceMm away
};

constexpr std::size_t kPanels = 4;
constexpr double kPanelReferenceMm = 640;

struct HeadLighting {                     // shares of the kiosk's own powers
  double left = 1, right = 1, below = 1;  // as the cameras see it
  double screen = 0;                      // of the light of a white page: the mean of its linear pixels
  Result<void> check() const;             // InvalidInput
};

std::array<Panel, kPanels> lamp_panels(const HeadLighting& lighting);
// What is seen where nothing stands.
Vec3 room_light(Vec3 direction);

}  // namespace relievo::hal::sim
