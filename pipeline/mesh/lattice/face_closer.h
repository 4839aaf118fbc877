// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closes a face: everything within its outline (face_outline.h) that was not measured gets a surface that continues what was,
// as curved as the mirrored other side where that was measured (thin_plate.h). Beside a nose, under it, in corners of eyes
// and mouth, beyond what both cameras saw of a cheek. Measured nodes stay where they
// are, but for the steep last two millimetres before a hole, which are laid anew.
#pragma once

#include <optional>

#include "pipeline/mesh/lattice/cell_mask.h"
#include "pipeline/mesh/lattice/face_outline.h"
#include "pipeline/mesh/lattice/lattice_surface.h"
#include "pipeline/stage.h"

namespace relievo::pipeline {

// A view's lattice, with room around what was measured. None where no head is found in it: then nothing is changed.
// Errors: Cancelled; throws std::bad_alloc.
Result<std::optional<FaceOutline>> close_face(PointLattice& lattice, LatticeSurface& surface, MaskShaper& shaper, StageContext& context);

}  // namespace relievo::pipeline
