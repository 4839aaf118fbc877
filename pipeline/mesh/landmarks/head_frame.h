// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The head's own frame, from the measured shape alone: origin at the tip of the nose (pronasale), on the
// plane of symmetry; x to the person's left, y up, z out of the face, millimetres. x is the normal of the
// face's plane of symmetry. y stands as in a head held upright (Frankfurt plane, to about 3 degrees): the
// brow leans before the cheeks beside the nose by what is usual; both are windows that cameras see however
// the head turns, filled from the other side where one is hidden. The tip is that of a robust paraboloid.
// Repeatable, of heads that turn by 25 and nod by 15 degrees, to 0.53 mm and 0.56 degrees at 1920 x 1200 (the
// worst of 80 pairs), to 1.3 and 0.7 at half of that (tests/bench/frame_repeatability). No axis of the
// camera enters but as a first guess. Memory: scratch only. Errors: PoorGeometry (too little surface, or no
// symmetry in it), Cancelled; throws std::bad_alloc as every stage does. Thread: any.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"

namespace relievo::pipeline {

struct HeadFrame {
  RigidTransform head_from_camera;
  double width_mm = 0;  // of the measured surface across, first to last percentile
  double height_mm = 0;
  double nose_relief_mm = 0;  // tip of the nose in front of the cheeks beside it; a photo on paper has none
  double asymmetry_mm = 0;    // median distance of the mirrored face from the face
};

// `mesh` in the left camera's frame, normals out of the face. Only measured vertices count, but for the
// tip, whose underside may not be. `across`: the first guess of which way runs across the person, from the
// left camera to the right one.
Result<HeadFrame> find_head_frame(const FaceMesh& mesh, StageContext& context,
                                  const Vec3d& across = {1, 0, 0});

// For a surface that need not be a head: as the left camera sees it, upright, about the middle of what was
// measured.
HeadFrame frame_as_seen(const FaceMesh& mesh, StageContext& context);

}  // namespace relievo::pipeline
