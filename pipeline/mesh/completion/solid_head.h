// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A solid for printing: the face, or the head fused of several pairs, with a usual person's head where
// nothing was measured (completion=generic-head), cut flat at the neck. Closed, each edge in two triangles,
// counter-clockwise from outside; without texture. What was measured above the cut stays where it is, the
// rest has `measured` 0. Memory: the mesh and the whole head in `output`, the rest in scratch; a copy of the
// model's mesh, lists of edges, Eigen's and CGAL's from the heap. Errors: PoorGeometry (no head is found in
// it, or it does not close); Cancelled; OutOfMemory. Thread: any.
#pragma once

#include "pipeline/base/kinds.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/face_model.h"

namespace relievo::pipeline {

// `head`: the completion that closes it, generic-head.
Result<FaceMesh> make_solid(const FaceModel& model, const Completion& head, StageContext& context);

}  // namespace relievo::pipeline
