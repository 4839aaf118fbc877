// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between the lids of an open eye a matcher measures lamps in the cornea and the iris behind it. What lies
// there is laid on a ball of an eye's size (Bekerman, Gottlieb, Vaiman 2014: 24.2 mm across, +-0.85), fitted
// robustly to all that was measured between the lids (find_lids), both eyes at once, about as each other's
// mirror images. What is moved is completed (measured = 0). Towards lids and corners, where no ball is, the
// surface spans from one to the other. Lids stay as measured; so does an eye whose lids are not found.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// `head_from_camera` as find_head_frame() gives it. Memory: scratch. Thread: any. Throws std::bad_alloc.
void lay_eyeballs(FaceMesh& mesh, const RigidTransform& head_from_camera, const RectifiedPair& pair,
                  StageContext& context);

}  // namespace relievo::pipeline
