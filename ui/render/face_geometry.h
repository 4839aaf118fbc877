// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaceProjection: where a model is seen in its window, for who draws it (FaceView) and for a finger on it.
// The model's frame is the head's, mm. Window: shares of its width and height from its upper left
// corner. Thread: any. Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/model/face_model.h"
#include "pipeline/model/point_cloud.h"
#include "pipeline/model/seam_split.h"
#include "ui/draw/draw_list.h"

namespace relievo::ui {

inline constexpr float kFaceDistanceMm = 640;  // of the viewer: a face is seen like this across a table
inline constexpr float kSeenHeightMm =
    272;  // of the window, at zoom 1: a face that is turned or nods stays inside

constexpr float radians(float degrees) { return degrees * 0.017453293F; }

// How a model stands before the viewer.
struct FaceStand {
  float middle_mm = 0;  // where its middle is, upwards, as it looks ahead
  float axis_mm = 0;    // behind the nose, about which it turns
  float fit = 1;        // smaller than a face is shown
};
FaceStand stand_of(const pipeline::FaceModel& model);

class FaceProjection {
 public:
  // `aspect`: the window's width over its height; `covered` as in FaceView::draw().
  FaceProjection(const FaceStand& stand, const FaceLook& look, float aspect, float covered);
  // Column-major, for the graphics card.
  const float* clip_from_model() const { return clip_; }
  const float* turned() const { return turned_; }

  pipeline::Vec2f seen(const pipeline::Vec3f& at_mm) const;
  // Of a millimetre beside the origin, across the view; the origin lies in the depth of the cheeks.
  float heights_per_mm() const { return scale_ / kFaceDistanceMm / 2; }
  // The nearest point of the surface there.
  std::optional<pipeline::Vec3f> touched(const pipeline::FaceModel& model, pipeline::Vec2f window) const;

 private:
  float clip_[16]{}, turned_[9]{};
  float shift_[3]{};  // of the origin, after it was turned
  float scale_ = 1, aspect_ = 1, covered_ = 0;
};

// What of a model is handed to the graphics card, in the head frame, mm, with the point the head turns about
// as its origin. Thread: main. Errors: none.

// Where triangles meet; `within` is how far from the rim of the surface it lies, 0 to 1.
struct Corner {
  float x, y, z, nx, ny, nz, u, v, within;
};

struct Tinted {
  float x, y, z;
  std::array<std::uint8_t, 4> rgba;
};

using Dot = pipeline::Vec3f;

// From the left camera's frame.
Dot dot_of(const pipeline::RigidTransform& head_from_camera, const pipeline::Vec3f& at_mm);
// One an entry of `split`, in its order.
std::vector<Corner> corners_of(const pipeline::FaceModel& model, const pipeline::SeamSplit& split);
// The cloud, or where there is none the mesh's vertices.
std::vector<Dot> dots_of(const pipeline::FaceModel& model, const pipeline::PointCloud* cloud);
// So many, now the first, lie apart: one in each cube of kApartMm.
inline constexpr float kApartMm = 3;
std::size_t set_apart(std::vector<Dot>& dots);
// The backdrop: two triangles a cell that shows anything.
std::vector<Tinted> tinted_of(const pipeline::FaceModel& model);

// The sides of a mesh's triangles, no finer than can be told apart: vertices about `least_mm` apart stand for
// those around them, and two are joined where their surroundings meet three by three (the dual of the Voronoi
// cells on the mesh). A mesh that is as coarse already keeps its own sides. Thread: any. Memory: the heap, in
// proportion to the mesh. Errors: none.

// Each once, two of the mesh's vertices.
using Edges = std::vector<std::array<std::uint32_t, 2>>;
Edges edges_of(const pipeline::FaceMesh& mesh, float least_mm);

}  // namespace relievo::ui
