// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simulated rig as a device of `scale` of its pixels either way. Its person is rendered once for all
// tests and runs where the environment's RELIEVO_ALBUM names a folder.
#pragma once

#include <cstdlib>
#include <filesystem>

#include "hal/sim/device.h"
#include "tests/support/small_rig.h"

namespace relievo::test {

inline std::filesystem::path album_folder() {
  const char* named = std::getenv("RELIEVO_ALBUM");
  return named != nullptr ? named : "";
}

inline hal::SimDeviceOptions small_device(double scale) {
  hal::SimDeviceOptions options;
  options.simulation.rig = small_rig(scale);
  options.album = album_folder();
  return options;
}

}  // namespace relievo::test
