// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceModel: the finished face, and what is known about how good it is.
#pragma once

#include <memory_resource>
#include <optional>

#include "hal/base/result.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/landmarks.h"
#include "pipeline/model/relief.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

struct ModelQuality {
  double median_sigma_mm = 0;  // of the measured vertices
  double measured_area_mm2 = 0;
  double coverage = 0;  // share of what is shown that was measured, the rest is completed: of the whole, or
                        // of mouth, nose or an eye, whichever has the least
  double width_mm = 0;  // of the surface in the head frame, first to last percentile
  double height_mm = 0;
  double nose_relief_mm = 0;        // tip of the nose in front of the cheeks
  double epipolar_residual_px = 0;  // rms vertical disagreement of the face's matches, before any realignment
  double texture_sharpness = 0;     // 0 blurred to 1 sharp, of the photographed texels (model_quality.h)
  double symmetry_residual_mm = 0;  // median distance of the mirrored face from the face
  ReliefFigures relief;             // all 0 where nothing could be told, or nobody asked
};

// Head frame: origin at the tip of the nose (pronasale), x to the person's left, y up, z out of the
// face. Mesh and normals stay in the left camera's frame; head_from_camera takes them over.
struct FaceModel {
  explicit FaceModel(std::pmr::memory_resource* memory) : mesh(memory), texture(memory), backdrop(memory) {}
  FaceMesh mesh;
  TextureAtlas texture;
  RigidTransform head_from_camera;
  Landmarks landmarks{};
  ModelQuality quality;
  Backdrop backdrop;              // shown behind the face, nothing else
  int poses_left_out = 0;         // of a head from several: they did not fit the others
  std::optional<Error> unjudged;  // why it is not known to be a face; then it may be looked at, not enrolled
};

}  // namespace relievo::pipeline
