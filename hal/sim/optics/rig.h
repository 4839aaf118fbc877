// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SimRig: the two simulated cameras, as exactly known as nothing in life is.
//
// World: the left camera before rectification: x right, y down, z forward, millimetres; pixel coordinates
// have their origin at the centre of the top left pixel. Lens: Brown-Conrady (k1 k2 p1 p2 k3), as OpenCV
// names them. Shares no code with the reconstruction. Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/base/result.h"
#include "hal/sim/base/vec3.h"

namespace relievo::hal::sim {

struct Pixel {
  double x = 0, y = 0;
};

struct SimView {
  int width_px = 0, height_px = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  Mat3 view_from_world;  // point_in_view = view_from_world * point + offset_mm
  Vec3 offset_mm;

  Pixel project(Vec3 point_in_world) const;
  double depth_mm(Vec3 point_in_world) const { return (view_from_world * point_in_world + offset_mm).z; }
  Vec3 ray(double x_px, double y_px) const;  // world direction, unit length; inverts the lens to 1e-9
  Vec3 centre() const { return -(view_from_world.transposed() * offset_mm); }
};

struct SimRig {
  SimView left, right;
};

struct RigOptions {
  int width_px = 1920, height_px = 1200;  // higher than wide: cameras turned to portrait
  double focal_px = 2950;                 // where the longer side has 1920; scales with it
  double baseline_mm = 140;
  double convergence_mm = 560;  // where both optical axes meet
  std::uint32_t seed = 1;
  double perturbation = 1;  // of every number above, as assembly tolerances; 0: ideal
  Result<void> check() const;
};

SimRig make_rig(const RigOptions& options);

// OpenCV's stereo YAML: image_width image_height K1 D1 K2 D2 R T (right from left, mm).
Result<void> write_rig(const std::filesystem::path& file, const SimRig& rig);

}  // namespace relievo::hal::sim
