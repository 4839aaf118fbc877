// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture held before the cameras: printed on paper, flat or bent, or shown on a screen. What a relief
// check has to tell from a face. Lit by the kiosk's lamps; glossy paper and glass mirror them.
// Thread: as Scene.
#pragma once

#include <memory>

#include "hal/picture_file.h"
#include "hal/sim/head/head_scene.h"
#include "hal/sim/optics/lamps.h"
#include "hal/sim/optics/scene.h"
#include "hal/sim/sheet/sheet_shape.h"

namespace relievo::hal::sim {

struct SheetLook {
  bool screen = false;         // shines by itself, and the room's light does not show on its black
  double brightness = 0.7;     // of white: a screen's light, or the share of light that paper gives back
  double gloss = 0;            // share of the lamps' light that is mirrored: 0 matt, 0.04 a film or glass
  double roughness = 0.05;     // of that mirror, radians: 0.02 glass, 0.15 satin paper
  Result<void> check() const;  // InvalidInput
};

struct SheetOptions {
  double width_mm = 270;  // of the picture as it is held; its height follows
  SheetBend bend;
  SheetLook look;
  HeadPose pose;  // turned as a head that looks at the cameras; its middle where a face's would be
  HeadLighting lamps;
  Result<void> check() const;  // InvalidInput
};

// `picture` is 8 bit, as a camera or printer has it (sRGB). Errors: InvalidInput.
Result<std::unique_ptr<Scene>> make_sheet_scene(const Picture& picture, const SheetOptions& options);

}  // namespace relievo::hal::sim
