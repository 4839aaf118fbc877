// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kiosk's light: two soft panels beside the cameras, a weak one below, the screen, and a dim room. World
// frame, mm.
// Thread: any.
#pragma once

#include <array>
#include <cstddef>

#include "hal/base/result.h"
#include "hal/sim/base/vec3.h"

namespace relievo::hal::sim {

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
