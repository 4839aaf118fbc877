// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts the field along occluding contours: where the left view looks past the edge of a near surface, the
// ridge of a nose, at a far one, a smooth field hangs a curtain from the one to the other. The curtain is
// steeper than skin that can be matched, it drags both surfaces along, and it holds itself up: half of its
// pixels agree with either. Both surfaces are continued under it, and each row is cut where the views agree
// best with the near one to the left and the far one to the right (no ordering is broken: the right view sees
// both, and more between them). Curtains that rise to the right hide the far surface from the right view:
// cross-check and uniqueness deal with them. Where a contour lies across, a chin before its throat, columns
// are cut the same way. Memory: scratch only. Results do not depend on the number of threads.
#pragma once

#include "pipeline/match/refine/surface_refiner.h"

namespace relievo::pipeline {

// `field` has a node on every pixel of the scene's level; its domain stays. How many rows and columns were
// cut.
int cut_at_occluding_contours(const RefinerScene& scene, StageContext& context, SurfaceField& field);

}  // namespace relievo::pipeline
