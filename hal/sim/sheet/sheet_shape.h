// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A sheet of paper, flat or bent: it bends without stretching (a developable surface), so lengths along
// it stay what they are. Sheet frame: origin in its middle, x to the right and y down as who looks at it
// sees them, z away from them, mm. Thread: any.
#pragma once

#include <vector>

#include "hal/base/result.h"
#include "hal/sim/base/vec3.h"
#include "hal/sim/optics/ray_caster.h"

namespace relievo::hal::sim {

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

}  // namespace relievo::hal::sim
