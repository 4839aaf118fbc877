// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rig's pictures of a picture, as files: what `relievo simulate photograph` writes. The picture is
// printed on paper, flat or bent, or shown on a screen, and held before the cameras: what a relief check has
// to tell from a face. Lit by the kiosk's lamps; glossy paper and glass mirror them. Thread: any;
// photograph_sheet() makes `threads` - 1 of its own meanwhile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "hal/base/result.h"
#include "hal/picture_file.h"
#include "hal/sim/base/vec3.h"
#include "hal/sim/head/head_scene.h"
#include "hal/sim/optics/ray_caster.h"
#include "hal/sim/optics/scene.h"
#include "hal/sim/render.h"

namespace relievo::hal::sim {

// A sheet of paper, flat or bent: it bends without stretching (a developable surface), so lengths along
// it stay what they are. Sheet frame: origin in its middle, x to the right and y down as who looks at it
// sees them, z away from them, mm.
struct SheetBend {
  double radius_mm = 0;        // in the middle; + bulges towards who looks, - away; 0: flat
  double axis_deg = 0;         // of the straight lines that stay: 0 upright (as on a column), 90 lying
  double apex_mm = 0;          // a cone: where those lines meet, from the middle along them; 0: they never do
  double wave_mm = 0;          // the bend turns over every half of this length; 0: it stays; not with apex_mm
  Result<void> check() const;  // InvalidInput
};

struct SheetSize {
  double width_mm = 210, height_mm = 297;
};

// Where the sheet's point (u, v), from its middle, comes to lie.
Vec3 bent(const SheetBend& bend, double u_mm, double v_mm);

struct SheetMesh {
  Mesh mesh;
  std::vector<std::array<float, 2>> paper_mm;  // u, v of every point
};
// A lattice so fine that it leaves the surface by less than 0.01 mm.
SheetMesh make_sheet(const SheetSize& size, const SheetBend& bend);

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
