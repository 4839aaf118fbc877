// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadPose: what one pair of pictures showed of a head, kept until the heads of all poses are fused: both
// rectified photographs, and a lattice of points with normals, in that pose's left camera's frame, with how
// that camera sees it, so that the surface at any place is found by projecting the place into the view.
// Millimetres. 32 bytes a node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/calibrate/drift.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/rectified_pair.h"

namespace relievo::pipeline {

// The surface at a node, or at a place that was projected into the view.
struct SurfaceHit {
  Vec3f at_mm;         // on the line of sight
  Vec3f normal;        // towards the camera, unit length
  float sigma_mm = 0;  // perpendicular to the surface
  float trust = 0;     // 0 at the edge of what was measured, beyond it, or where it is seen edge-on, to 1
};

// A rectified photograph is 0 0 0 where it ends, and only there. Whether it covers the pixel, counted row by
// row.
inline bool is_photographed(std::span<const std::uint8_t> rgb, std::size_t pixel) {
  return rgb[3 * pixel] != 0 || rgb[3 * pixel + 1] != 0 || rgb[3 * pixel + 2] != 0;
}

// Skin that another pose shows, too.
struct SharedSkin {
  std::uint32_t pose = 0, node = 0;  // which one, and where on its lattice
  Vec3f at_mm;                       // where this pose has it, in its own frame
};

struct HeadPose {
  explicit HeadPose(std::pmr::memory_resource* memory)
      : nodes(memory), left_rgb(memory), right_rgb(memory), shared_skin(memory) {}
  int columns = 0, rows = 0;
  // How the rectified left view sees the left camera's frame.
  Rotation rectified_from_camera;
  double focal_px = 0;
  Vec2d centre_px;
  Vec2d first_px;  // of node (0, 0)
  double step_px = 1;
  // columns * rows, row by row; a place is looked up among four of them, so that all of one lies together.
  std::pmr::vector<SurfaceHit> nodes;
  RigidTransform head_from_camera;
  bool has_head = false;  // whether a head frame was found
  // The rectified photographs; none: only shape tells how the pose lies.
  int width_px = 0, height_px = 0;
  std::pmr::vector<std::uint8_t> left_rgb, right_rgb;
  Vec2d right_centre_px;
  double baseline_mm = 0;
  DriftJudgement drift;  // what the matches say of the calibration; the caller refuses
  std::optional<RigidTransform> first_from_pose;  // where it was laid onto the poses before it, if it was
  std::pmr::vector<SharedSkin> shared_skin;       // with the poses it was laid onto

  // `place_mm` in this pose's left camera's frame. None where nothing was measured, or the surface is torn.
  std::optional<SurfaceHit> look(const Vec3f& place_mm) const;
};

// What a pose that was placed in the first one's frame shows of a place there: its normal, and by how much
// the place lies before it along that.
struct PlacedHit {
  SurfaceHit own;  // its own frame
  Vec3d normal;
  double before_mm = 0;
};
std::optional<PlacedHit> look(const HeadPose& pose, const RigidTransform& first_from_pose,
                              const Vec3d& place_mm);

// Of a cloud on a lattice. Nodes on the edge of what was measured and surface steeper than 75 degrees to the
// line of sight go. Memory: output; scratch. Thread: any. Errors: Unsupported (scattered points),
// PoorGeometry (no surface), Cancelled; throws std::bad_alloc.
Result<HeadPose> make_head_pose(const PointCloud& cloud, const RectifiedPair& pair, StageContext& context);

// Every so many nodes of its largest part, to find a head's frame on; empty where there are none. Memory:
// output; scratch. Throws std::bad_alloc.
FaceMesh coarse_mesh(const HeadPose& pose, int most_triangles, StageContext& context);

// Lets trust fade over so many nodes to where it ends. Throws std::bad_alloc.
void fade_to_edges(HeadPose& pose, float nodes, std::pmr::memory_resource* scratch);

}  // namespace relievo::pipeline
