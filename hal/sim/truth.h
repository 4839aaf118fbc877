// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is really there, for every pixel of the left picture. For tests and benchmarks
// only: nothing that reconstructs may include this.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "hal/base/result.h"
#include "hal/base/thread_pool.h"
#include "hal/sim/optics/rig.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {

struct Truth {
  static constexpr std::uint8_t kSkin = 1;        // face skin, not under hair
  static constexpr std::uint8_t kSeenByBoth = 2;  // in the right picture too, and not hidden
  static constexpr std::uint8_t kNotGrazing = 4;  // both viewing angles below 60 degrees
  int width_px = 0, height_px = 0;
  std::vector<float> depth_mm;  // z in the left camera's frame; NaN: nothing there
  std::vector<std::uint8_t> flags;
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x);
  }
};

Truth measure_truth(const Scene& scene, const SimRig& rig, ThreadPool& pool);

// "w h z" and a new line, then all depths as float32, then all flags as bytes.
Result<void> write_truth(const std::filesystem::path& file, const Truth& truth);
// Binary PLY, camera frame, mm.
Result<void> write_mesh(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace relievo::hal::sim
