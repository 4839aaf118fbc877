// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps the face of a measured head: everything within a ball around the tip of the nose, as 3D face
// recognition crops it. Collar, shoulders and what stands beside the head go.
// The tip is what stands out furthest in the middle of the detected face (match/region/face_reach.h).
// Memory: scratch only; the cloud shrinks in place and keeps its order. Thread: any.
#pragma once

#include "pipeline/base/options.h"
#include "pipeline/base/stage.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

struct FaceCropOptions {
  double radius_mm = 104;  // tip of the nose to the hairline and the chin: 95 and 75 on a grown-up

  void describe(auto&& field) {
    field("radius_mm", radius_mm, OptionRange{40, 1000},
          "surface further from the tip of the nose is not the face, mm");
  }
};

// Does nothing to a pair in which no face was looked for (face_width_px is 0).
// Errors: NoFace when nothing was measured in the middle of the face.
Result<void> crop_to_face(PointCloud& cloud, const RectifiedPair& pair, const FaceCropOptions& options,
                          StageContext& context);

}  // namespace relievo::pipeline
