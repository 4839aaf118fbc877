// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Completion: gives a measured surface what the cameras did not see. Completed vertices carry measured = 0
// and a sigma_mm of their own; what was measured stays bit for bit where it is. One connected manifold
// surface comes out. A surface in which no head is found, or to which nothing can be added, comes back as it
// is. Errors: OutOfMemory, Cancelled.
#pragma once

#include <functional>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"

namespace relievo::pipeline {

// `across`: which way runs across the person, as find_head_frame() wants it.
using Completion = std::function<Result<FaceMesh>(FaceMesh mesh, const Vec3d& across, StageContext& context)>;

}  // namespace relievo::pipeline
