// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What can be said about a finished surface without knowing the truth.
#pragma once

#include "pipeline/base/stage.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/face_model.h"

namespace relievo::pipeline {

// Everything but epipolar_residual_px (the matches know it), relief and texture_sharpness. Memory: scratch
// only.
ModelQuality measure_quality(const FaceMesh& mesh, const HeadFrame& frame, StageContext& context);

}  // namespace relievo::pipeline
