// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the backdrop of a face: on the head's chart (head_chart.h) its rim is continued to a head's rough
// shape, an ellipsoid, and coloured by the left photograph. It fades with the distance from the face, where
// it turns away from the camera, and beside the jaw where it looks like the room there, so that little of the
// room is left. Memory: the backdrop in `output`, the rest in `scratch`. Thread: any. Throws std::bad_alloc.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/rectified_pair.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

Backdrop make_backdrop(const FaceMesh& mesh, const RigidTransform& head_from_camera,
                       const RectifiedPair& pair, StageContext& context);

}  // namespace relievo::pipeline
