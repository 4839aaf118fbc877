// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measurement: how far a model is from the truth. Millimetres; shares of 1.
//   accuracy  from points spread evenly over the model's measured surface, where it is judged face
//   interior  the same, where the whole 23 pixel window around is judged face
//   complete  share of the judged true face with model surface within the distance
//   outliers  share of the model's measured surface further than 3 mm from the true head
//   sigma     share of vertices whose error is within one, and 1.96, of their own sigma_mm: honest
//             models say 0.68 and 0.95
// The model is first moved rigidly onto the truth (its calibration is an estimate); never scaled.
// Thread: any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/base/groups.h"
#include "hal/base/result.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/face_mesh.h"
#include "pipeline/model/vector3.h"

namespace relievo::firmware::measure {

using pipeline::Vec3d, pipeline::Vec3f;

// TriangleGrid: a surface of triangles that answers "what is the nearest point on you?". A uniform
// grid over the triangles' boxes; the search goes outwards ring by ring and is exact within its
// reach. Millimetres, any frame. Thread: any number at once, once built.
struct Surface {
  std::vector<Vec3f> vertices_mm;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Nearest {
  double distance_mm = 0;
  Vec3d at_mm;
  Vec3d normal;  // of the triangle, unit length, either side
};

class TriangleGrid {
 public:
  explicit TriangleGrid(const Surface& surface);  // borrowed
  // Nothing within reach_mm.
  std::optional<Nearest> nearest(const Vec3d& point_mm, double reach_mm) const;

 private:
  struct Cell {
    int x, y, z;
  };
  struct Found {
    double best = 0;  // how far
    std::optional<std::uint32_t> which{};
    Vec3d at{};
  };
  Cell cell_of(const Vec3d& point_mm) const;
  std::size_t index_of(const Cell& cell) const;
  void look(const Cell& cell, const Vec3d& point_mm, Found& found) const;
  void look_at_ring(const Cell& centre, int ring, const Vec3d& point_mm, Found& found) const;

  const Surface& surface_;
  double cell_mm_ = 1;
  Vec3d origin_mm_;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  Groups triangles_;  // of each cell
};

// TruthView: what the simulated rig knows and the reconstruction does not: for every pixel of the
// left picture how deep the scene is there, and whether it is a piece of face that can be asked for.
// A folder with rig.yml (the true rig) and truth.bin: "WIDTH HEIGHT z" and a line feed, then a
// float32 depth a pixel (left camera's z, mm, NaN where nothing is), then a byte of flags a pixel.
// Errors: NotFound, IoFailed, InvalidInput. Thread: any.

// The true surface of a simulated head, also where no camera sees it: head.ply (binary, float x y z,
// triangles) in the left camera's frame, millimetres.
Result<Surface> read_true_surface(const std::filesystem::path& file);
// Nothing but this one form of PLY. An error has no place.
Result<Surface> parse_true_surface(std::string_view bytes);

class TruthView {
 public:
  // truth.bin's own bits, and one of ours.
  static constexpr std::uint8_t kSkin = 1;     // skin of the face
  static constexpr std::uint8_t kBothSee = 2;  // seen by both cameras
  static constexpr std::uint8_t kSteep = 4;    // cleared where either camera looks on too steeply
  static constexpr std::uint8_t kJudged = kSkin | kBothSee | kSteep;
  static constexpr std::uint8_t kInterior = 8;  // judged, and so is the 23 pixel window around it

  static Result<TruthView> read(const std::filesystem::path& folder);

  // The judged flags of the pixel onto which the point falls; 0 outside the picture.
  std::uint8_t flags_at(const Vec3d& point_mm) const;
  // Where a ray of the left camera's frame meets the judged face; between pixels the depth is interpolated.
  // None where one of the four pixels around is no piece of it.
  std::optional<Vec3d> judged_point_along(const Vec3d& ray) const;
  // Points of the judged face, about `count` of them, evenly over the picture.
  std::vector<Vec3d> judged_points(std::size_t count) const;

 private:
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width_px_) + std::size_t(x); }
  void keep_near_nose();
  void mark_interior();

  int width_px_ = 0;
  int height_px_ = 0;
  pipeline::CameraIntrinsics left_;
  std::vector<Vec3f> points_mm_;  // left camera's frame; z is NaN where nothing is
  std::vector<std::uint8_t> flags_;
};

// The rigid motion that lays points on a surface: point to plane, least squares, far ones left out
// more and more strictly (Chen, Medioni 1992). Reaches about 12 mm; never scales. Millimetres.
struct RigidFit {
  pipeline::RigidTransform surface_from_points;
  double moved_mm = 0;  // the middle point's way
  double turned_deg = 0;
};

RigidFit fit_rigidly(const std::vector<Vec3d>& points_mm, const TriangleGrid& surface);

struct Measurement {
  double accuracy_median_mm = 0, accuracy_p95_mm = 0;
  double interior_median_mm = 0, interior_p95_mm = 0;
  double complete_quarter_mm = 0, complete_half_mm = 0, complete_1mm = 0;
  double outliers_3mm = 0;
  double within_sigma = 0, within_196_sigma = 0;
  std::size_t measured_vertices = 0;
  double moved_mm = 0, turned_deg = 0;
};

Measurement measure(const pipeline::FaceMesh& mesh, const TruthView& truth, const Surface& true_surface);

}  // namespace relievo::firmware::measure
