// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Glasses on a simulated person: two curved lenses that mirror the kiosk's lamps (Schlick's reflectance of
// both faces) and pass the rest, dark rims, a bridge and temples. Lenses refract nothing and throw no shadow.
// Frame of the glasses: that of the head. Thread: any, once built.
#pragma once

#include <array>
#include <memory>

#include "hal/sim/head/head_scene.h"

namespace relievo::hal::sim {

struct Glasses {
  double curve_mm = 88;  // radius of the lenses' front: 6 dioptres
  double half_width_mm = 24, half_height_mm = 16;
  double tilt_deg = 8;   // the lenses look down (pantoscopic)
  double passes = 0.92;  // of the light; dark ones 0.1
  double rim_mm = 2.2;
};

struct Wearer {              // head frame, mm
  std::array<Vec3, 2> eyes;  // middles of the eyeballs: left, right
  double eye_radius = 12, head_breadth = 150;
};
Wearer wearer_of(const HeadModel& head);

// Worn before `face`, the wearer's scene in the same pose.
std::unique_ptr<Scene> make_glasses_scene(std::unique_ptr<Scene> face, const Wearer& wearer,
                                          const HeadPose& pose, const Glasses& glasses,
                                          const HeadLighting& lighting = {});

// Area before the openings of both eyes, as `camera` (world, mm) sees them, where a lens mirrors a lamp; the
// larger of the two eyes'.
double mirrored_mm2(const Wearer& wearer, const HeadPose& pose, const Glasses& glasses, Vec3 camera,
                    const HeadLighting& lighting = {});

}  // namespace relievo::hal::sim
