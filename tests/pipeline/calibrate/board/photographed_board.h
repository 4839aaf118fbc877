// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated board before one simulated camera (640x400, where nothing else is asked for): where the lens
// puts its corners is known.
#pragma once

#include <cmath>
#include <limits>

#include "hal/picture_file.h"
#include "hal/sim/board_scene.h"
#include "hal/sim/optics/exposure.h"
#include "pipeline/calibrate/board/board_finder.h"

namespace relievo::tests {

struct PhotographedBoard {
  int width_px = 640;
  hal::sim::BoardPattern print;
  hal::sim::BoardLook look;
  double tilt_deg = 20, compass_deg = 30, roll_deg = 5;  // tilted towards the compass' direction
  double distance_mm = 600;
  double right_mm = 0, down_mm = 0;
  double blur_px = 0.6;
  double noise = 1;
  unsigned seed = 1;

  hal::sim::SimView view() const {
    hal::sim::RigOptions rig;
    rig.width_px = width_px;
    rig.height_px = width_px * 5 / 8;
    return hal::sim::make_rig(rig).left;
  }
  hal::sim::BodyPose pose() const {
    using namespace hal::sim;
    const SimView camera = view();
    const double tilt = radians(tilt_deg), compass = radians(compass_deg);
    BodyPose at;
    at.world_from_body =
        rotation(tilt * std::sin(compass), tilt * std::cos(compass), 0) * rotation(0, 0, radians(roll_deg));
    const Vec3 middle{(print.corners_x - 1) * print.square_mm / 2,
                      (print.corners_y - 1) * print.square_mm / 2, 0};
    const Vec3 aim = camera.ray((camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0);
    at.origin_mm = aim * distance_mm + Vec3{right_mm, down_mm, 0} - at.world_from_body * middle;
    return at;
  }
  hal::Picture photograph() const {
    const hal::sim::SimView camera = view();
    hal::sim::SensorOptions sensor;
    sensor.grey = true;
    sensor.noise = noise;
    sensor.defocus_px = blur_px;
    ThreadPool pool(2);
    const hal::sim::BoardScene scene(print, pose(), look, 1 / camera.fx_px);
    return hal::sim::read_sensor(hal::sim::expose(scene, camera, sensor, pool), sensor, seed);
  }
  pipeline::BoardPattern pattern() const {
    pipeline::BoardPattern out{print.corners_x, print.corners_y, print.square_mm};
    if (print.kind == hal::sim::BoardKind::Charuco) out.kind = pipeline::BoardKind::Charuco;
    out.marker_mm = print.marker_mm;
    out.marker_bits = print.marker_bits;
    return out;
  }
  pipeline::Vec2d truth(int column, int row) const {
    const auto at = view().project(pose().to_world({column * print.square_mm, row * print.square_mm, 0}));
    return {at.x, at.y};
  }
};

struct CornerErrors {
  int seen = 0;
  double rms_px = std::numeric_limits<double>::infinity();
  double worst_px = 0;
};

// In the order found.
inline CornerErrors errors_of(const pipeline::BoardCorners& found, const PhotographedBoard& board) {
  CornerErrors errors;
  double squares = 0;
  for (int i = 0; i < board.pattern().corners(); ++i) {
    const pipeline::Vec2d& at = found[static_cast<std::size_t>(i)];
    if (!pipeline::seen(at)) continue;
    const pipeline::Vec2d truth = board.truth(i % board.print.corners_x, i / board.print.corners_x);
    const double off = std::hypot(at.x - truth.x, at.y - truth.y);
    squares += off * off;
    errors.worst_px = std::max(errors.worst_px, off);
    ++errors.seen;
  }
  if (errors.seen > 0) errors.rms_px = std::sqrt(squares / errors.seen);
  return errors;
}

}  // namespace relievo::tests
