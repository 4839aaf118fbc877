// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simulated rig's own numbers as a calibration, and what a knock does to one.
// Pixels, millimetres, radians.
#pragma once

#include "hal/sim/optics/rig.h"
#include "pipeline/model/calibration.h"

namespace relievo::test {

// The left camera is the world, so the right view's pose is right-from-left already.
inline pipeline::StereoCalibration true_calibration(const hal::sim::SimRig& rig) {
  const auto camera = [](const hal::sim::SimView& v) {
    return pipeline::CameraIntrinsics{
        {v.fx_px, v.fy_px}, {v.cx_px, v.cy_px}, {v.k1, v.k2, v.p1, v.p2, v.k3}, v.width_px, v.height_px};
  };
  pipeline::StereoCalibration c;
  c.left = camera(rig.left);
  c.right = camera(rig.right);
  for (int row = 0; row < 3; ++row) {
    const hal::sim::Vec3 r = rig.right.view_from_world.row[static_cast<std::size_t>(row)];
    double* m = c.right_from_left.rotation.m + 3 * row;
    m[0] = r.x, m[1] = r.y, m[2] = r.z;
  }
  const hal::sim::Vec3 t = rig.right.offset_mm;
  c.right_from_left.translation_mm = {t.x, t.y, t.z};
  return c;
}

// The right camera turned about its own centre: about its x axis (nod), y (pan) and z (roll).
inline pipeline::StereoCalibration turned(const pipeline::StereoCalibration& from, double nod, double pan,
                                          double roll) {
  const hal::sim::Mat3 turn = hal::sim::rotation(nod, pan, roll);
  const auto by_turn = [&turn](double x, double y, double z) { return turn * hal::sim::Vec3{x, y, z}; };
  pipeline::StereoCalibration to = from;
  for (int column = 0; column < 3; ++column) {
    const double* m = from.right_from_left.rotation.m;
    const hal::sim::Vec3 v = by_turn(m[column], m[3 + column], m[6 + column]);
    double* out = to.right_from_left.rotation.m;
    out[column] = v.x, out[3 + column] = v.y, out[6 + column] = v.z;
  }
  const pipeline::Vec3d& t = from.right_from_left.translation_mm;
  const hal::sim::Vec3 moved = by_turn(t.x, t.y, t.z);
  to.right_from_left.translation_mm = {moved.x, moved.y, moved.z};
  return to;
}

}  // namespace relievo::test
