// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rig's pictures of a picture, as files: what `relievo simulate photograph` writes.
// Thread: any; makes `threads` - 1 of its own meanwhile.
#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/sim/render.h"
#include "hal/sim/sheet/sheet_scene.h"

namespace relievo::hal::sim {

struct SheetPhotoOptions {
  RigOptions rig;
  SensorOptions sensor;
  SheetOptions sheet;
  std::uint32_t seed = 1;  // of the noise
  int threads = 2;
};

// left.png right.png rig.yml. Makes the folder. Errors: InvalidInput, IoFailed, MediaFull.
Result<void> photograph_sheet(const Picture& picture, const SheetPhotoOptions& options,
                              const std::filesystem::path& folder);

}  // namespace relievo::hal::sim
