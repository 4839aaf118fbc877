// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The head's own frame, from the measured shape alone: origin at the tip of the nose (pronasale),
// x to the person's left, y up, z out of the face, millimetres. x is the normal of the face's plane
// of symmetry; y runs along the cheeks and forehead beside the nose; the tip is where the face stands
// out most beside that plane. Works on turned heads: no axis of the camera enters but as a first guess.
// Memory: scratch only. Errors: PoorGeometry (too little surface, or no symmetry in it), Cancelled;
// throws std::bad_alloc as every stage does. Thread: any.
#pragma once

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/geometry.h"
#include "pipeline/options.h"
#include "pipeline/stage.h"

namespace relievo::pipeline {

struct HeadFrameOptions {
  int sample_points = 6000;   // points of the surface that vote
  double face_radius_mm = 75; // around the tip: the surface that fixes how the head nods

  Result<void> check() const;
};

template <typename Field>
void describe(HeadFrameOptions& o, Field&& field) {
  field("sample_points", o.sample_points, OptionRange{500, 100000}, "points of the surface that fix the head's frame");
  field("face_radius_mm", o.face_radius_mm, OptionRange{40, 120}, "surface this near the tip of the nose fixes how the head nods");
}

struct HeadFrame {
  RigidTransform head_from_camera;
  double width_mm = 0;        // of the measured surface across, first to last percentile
  double height_mm = 0;
  double nose_relief_mm = 0;  // tip of the nose in front of the cheeks beside it; a photo on paper has none
  double asymmetry_mm = 0;    // median distance of the mirrored face from the face
  double overlap = 0;         // share of the surface whose mirror image meets surface
};

// `mesh` in the left camera's frame, normals out of the face. Only measured vertices count. `across`: the
// first guess of which way runs across the person, from the left camera to the right one.
Result<HeadFrame> find_head_frame(const FaceMesh& mesh, const HeadFrameOptions& options, StageContext& context,
                                  const Vec3d& across = {1, 0, 0});

}  // namespace relievo::pipeline
