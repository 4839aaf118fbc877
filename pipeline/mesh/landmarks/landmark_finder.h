// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The named points of a face, from the measured shape alone. Those on the plane of symmetry come from the
// profile (face_profile.h); inner corners of the eyes and corners of the mouth are pits, found where both
// sides of the face bend most like one near the place that anthropometry expects them (Farkas 1994); the
// outer corners of the eyes leave hardly a trace on a surface and lie where the inner ones say, less surely.
// Sigmas are those of simulated heads against truth (tests/bench/frame_repeatability prints them).
// A point is not found where its surroundings were not measured. Memory: scratch only. Thread: any.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/landmarks.h"

namespace relievo::pipeline {

// `head_from_camera` as find_head_frame() gives it. Errors: Cancelled.
Result<Landmarks> find_landmarks(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                                 StageContext& context);

}  // namespace relievo::pipeline
