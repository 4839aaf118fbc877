// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a scene to a sensor's picture: rays through the bent lens, a slightly soft focus, light
// counted in electrons with their noise, and the usual curve from light to 8 bit.
// Thread: one caller; expose() uses the pool.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/thread_pool.h"
#include "hal/picture_file.h"
#include "hal/sim/optics/rig.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {

struct LightPicture {  // linear, 3 floats a pixel
  int width_px = 0, height_px = 0;
  std::vector<float> rgb;
};

struct SensorOptions {
  double exposure = 1.0;
  double full_well_electrons = 9000;  // at white
  double read_noise_electrons = 9;
  double noise = 1;          // scales both; 0: none
  double defocus_px = 0.55;  // deviation of the blur
  bool gamma = true;         // sRGB's curve; false: linear
  bool grey = false;
};

double srgb(double light);  // of linear light, both 0 to 1
// A fixed grid of samples a pixel, more where bodies meet or hair runs.
LightPicture expose(const Scene& scene, const SimView& view, const SensorOptions& sensor, ThreadPool& pool);
Picture read_sensor(const LightPicture& light, const SensorOptions& sensor, std::uint64_t noise_seed);

}  // namespace relievo::hal::sim
