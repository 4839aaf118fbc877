// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simulated rig for light tests: its cameras stand and see as they do, with `scale` of the pixels either
// way.
#pragma once

#include <cmath>

#include "hal/sim/optics/rig.h"

namespace relievo::test {

inline hal::sim::RigOptions small_rig(double scale) {
  hal::sim::RigOptions rig;
  rig.width_px = static_cast<int>(std::lround(rig.width_px * scale));
  rig.height_px = static_cast<int>(std::lround(rig.height_px * scale));
  return rig;
}

}  // namespace relievo::test
