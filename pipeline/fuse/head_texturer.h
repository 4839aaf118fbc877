// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The photographs of all poses on a fused head, in one atlas. Every texel shows the photograph that looks at
// it straightest, and gives way to the next over a short stretch (cosine weights; Debevec, Taylor, Malik
// 1996). The light stays where it is while the head turns: each photograph is brought to the others' level by
// a slowly varying difference, so that no seam is left where one ends (Lempitsky, Ivanov 2007). Surface that
// was completed and not measured shows the master's photograph nearly alone: eyes and lips move. Another
// pose's photograph counts only where its own pair measured skin, or skin around. What no camera saw, and
// what closes a hole, is filled and flagged. Memory: the atlas in `output`, the rest in `scratch`. Thread:
// any; works on the pool, the result does not depend on its size. Errors: Cancelled; throws std::bad_alloc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/base/stage.h"
#include "pipeline/fuse/head_pose.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/texture_atlas.h"

namespace relievo::pipeline {

// A rectified photograph and the camera that took it.
struct HeadView {
  std::span<const std::uint8_t> rgb;  // 3 a pixel; 0 0 0 where the photograph ends
  int width_px = 0, height_px = 0;
  double focal_px = 0;
  Vec2d centre_px;
  RigidTransform view_from_head;  // from the mesh's frame into the camera's, rectified
  bool master = false;
  bool right = false;
  const HeadPose* pose = nullptr;  // whose photograph it is, and what that measured; none: all it shows
  RigidTransform pose_from_head;
};

// The mesh's vertices from `closing` on close holes.
Result<TextureAtlas> texture_head(const FaceMesh& mesh, std::size_t closing, std::span<const HeadView> views,
                                  int max_atlas_px, StageContext& context);

}  // namespace relievo::pipeline
