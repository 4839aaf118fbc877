// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The calibration with which the targets are measured: made from photographed boards by the product's
// own finder and calibrator, never taken from the rig's truth.
// Errors: the rig's, the finder's and the calibrator's; PoorGeometry where its verdict is refuse;
// Cancelled. Thread: worker.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "firmware/jobs/job_thread.h"
#include "hal/base/result.h"
#include "hal/picture_file.h"
#include "pipeline/calibrate/calibrator.h"
#include "pipeline/model/geometry.h"

namespace relievo::firmware {

// What the optical self-test puts before the cameras, and how it is photographed. Plain data: the
// simulated rig stands behind Photograph in main.cc and in tests, nothing here knows it.
// Target frame: origin in the middle of the target, x along the dumbbell's rod or the plate's width,
// y along the plate's height, z into the target; mm. Places are given in the left camera's frame.
struct OpticalTargets {                    // what their certificate says
  int board_columns = 10, board_rows = 7;  // inner corners
  double square_mm = 20;
  double sphere_diameter_mm = 60;  // of both spheres of the dumbbell
  double sphere_spacing_mm = 120;  // between their centres
  double rod_diameter_mm = 8;      // between them
  double plate_width_mm = 240, plate_height_mm = 180;
};

struct TargetPlace {
  double right_mm = 0, down_mm = 0, distance_mm = 560;  // of the middle
  double pitch_deg = 0, yaw_deg = 0, roll_deg = 0;      // about x, then y, then z of the camera
};

enum class TargetKind : std::uint8_t { Board, Dumbbell, Plate };

struct TargetShot {
  TargetKind kind = TargetKind::Board;
  int number = 0;     // of its kind; a board's place follows from it and from `count`
  int count = 0;      // boards in the series
  TargetPlace place;  // of dumbbell and plate
  OpticalTargets targets;
  std::uint32_t seed = 1;  // the rig's tolerances, the speckle, the noise
  double scale = 1;        // of the pictures' width and height
};

struct TargetPictures {
  hal::Picture left, right;
};

// Errors: the rig's own (PoorGeometry: the target does not fit into the views).
using Photograph = std::function<Result<TargetPictures>(const TargetShot&)>;

inline pipeline::Vec3d left_from_target(const TargetPlace& place, const pipeline::Vec3d& p) {
  constexpr double kRadians = std::numbers::pi / 180;
  const double a = place.pitch_deg * kRadians, b = place.yaw_deg * kRadians, c = place.roll_deg * kRadians;
  const pipeline::Vec3d x{p.x, p.y * std::cos(a) - p.z * std::sin(a), p.y * std::sin(a) + p.z * std::cos(a)};
  const pipeline::Vec3d y{x.x * std::cos(b) + x.z * std::sin(b), x.y, x.z * std::cos(b) - x.x * std::sin(b)};
  return {y.x * std::cos(c) - y.y * std::sin(c) + place.right_mm,
          y.x * std::sin(c) + y.y * std::cos(c) + place.down_mm, y.z + place.distance_mm};
}

// `each` is called after every board.
Result<pipeline::CalibratorOutput> calibrate_on_boards(const Photograph& photograph, const TargetShot& series,
                                                       int boards, const std::atomic<bool>& cancelled,
                                                       const std::function<void()>& each);

}  // namespace relievo::firmware
