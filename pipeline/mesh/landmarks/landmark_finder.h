// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The named points of a face. Those on the plane of symmetry come from the profile (face_profile.h). Corners
// of the eyes are those of the lids (find_lids); without lids the inner ones are pits, found like the
// corners of the mouth where both sides of the face bend most like one near the place that anthropometry
// expects (Farkas 1994), and the outer ones lie where the inner ones say, less surely. On a completed part of
// the surface a point is twice as uncertain.
// Sigmas are those of simulated heads against truth (tests/bench/frame_repeatability prints them).
// Memory: scratch only. Thread: any.
#pragma once

#include <array>
#include <optional>

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/landmarks.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// Where an open eye lies between its lids, by the left photograph: sclera and most irises are less red than
// skin is, under any lamp, and the lids' margins are redder. Of all almonds (two parabolas that meet in the
// corners of the eye) the one is taken that parts the one from the other best; how large eyes are (Farkas
// 1994) weighs little against it. Grey brows are as little red: where an almond below the best one has more
// contrast, that is the eye.
//
// In the head's frame (head_frame.h), seen from the front; millimetres.
struct Lids {
  Vec2d inner, outer;           // corners of the eye
  double upper = 0, lower = 0;  // how far the lids' margins lie from the line between the corners, half way

  // How far within the margins, measured upright; negative outside.
  double depth(const Vec2d& p) const {
    const double along = (p.x - inner.x) / (outer.x - inner.x), line = inner.y + along * (outer.y - inner.y);
    const double arc = 4 * along * (1 - along);
    if (along <= 0 || along >= 1) return -1;
    return p.y > line ? line + upper * arc - p.y : p.y - line + lower * arc;
  }
};

// The person's right eye, then the left one; none where an eye is closed, hidden, or the picture has no
// colours. Memory: scratch. Throws std::bad_alloc.
std::array<std::optional<Lids>, 2> find_lids(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                                             const RectifiedPair& pair, StageContext& context);

// `head_from_camera` as find_head_frame() gives it, `eyes` as find_lids(). Errors: Cancelled.
Result<Landmarks> find_landmarks(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                                 const std::array<std::optional<Lids>, 2>& eyes, StageContext& context);

}  // namespace relievo::pipeline
