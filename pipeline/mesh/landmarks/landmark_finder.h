// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The named points of a face. Those on the plane of symmetry come from the profile (face_profile.h). Corners
// of the eyes are those of the lids (lid_finder.h); without lids the inner ones are pits, found like the
// corners of the mouth where both sides of the face bend most like one near the place that anthropometry
// expects (Farkas 1994), and the outer ones lie where the inner ones say, less surely. On a completed part of
// the surface a point is twice as uncertain.
// Sigmas are those of simulated heads against truth (tests/bench/frame_repeatability prints them).
// Memory: scratch only. Thread: any.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/mesh/landmarks/lid_finder.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/landmarks.h"

namespace relievo::pipeline {

// `head_from_camera` as find_head_frame() gives it, `eyes` as find_lids(). Errors: Cancelled.
Result<Landmarks> find_landmarks(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                                 const std::array<std::optional<Lids>, 2>& eyes, StageContext& context);

}  // namespace relievo::pipeline
