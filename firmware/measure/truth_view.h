// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// TruthView: what the simulated rig knows and the reconstruction does not: for every pixel of the
// left picture how deep the scene is there, and whether it is a piece of face that can be asked for.
// A folder with rig.yml (the true rig) and truth.bin: "WIDTH HEIGHT z" and a line feed, then a
// float32 depth a pixel (left camera's z, mm, NaN where nothing is), then a byte of flags a pixel.
// Errors: NotFound, IoFailed, InvalidInput. Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/measure/triangle_grid.h"
#include "hal/base/result.h"
#include "pipeline/model/calibration.h"

namespace relievo::firmware::measure {

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

}  // namespace relievo::firmware::measure
