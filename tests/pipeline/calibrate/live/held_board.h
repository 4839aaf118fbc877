// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners of a board in a hand, as a known rig sees them: for the decisions of a live calibration.
#pragma once

#include <chrono>
#include <cmath>
#include <random>

#include "pipeline/calibrate/live/live_calibration.h"
#include "tests/pipeline/calibrate/simulated_boards.h"

namespace relievo::tests {

inline const pipeline::BoardPattern kHeldPattern{7, 5, 28};

// Middle of the board in the left camera's frame, mm; turned by roll, then pitch (upper edge nearer),
// then yaw (left edge nearer); degrees.
struct BoardAt {
  double right_mm = 0, down_mm = 0, distance_mm = 560;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

// A rig like the product's: two toed-in cameras that see the same 360 mm by 230 mm at 560 mm.
inline SimulatedRig kiosk_rig(unsigned seed = 0) {
  std::mt19937 random(seed * 7919U + 1);
  const auto about = [&](double middle, double by) {
    return middle + (seed == 0 ? 0 : std::uniform_real_distribution<double>(-by, by)(random));
  };
  SimulatedRig rig;
  rig.width_px = 1920;
  rig.height_px = 1200;
  for (int eye = 0; eye < 2; ++eye) {
    rig.focal[eye] = about(2950, 60);
    rig.centre[eye][0] = about(959.5, 20);
    rig.centre[eye][1] = about(599.5, 20);
    const double distortion[5] = {about(-0.1, 0.02), about(0.11, 0.03), about(3e-4, 3e-4), about(-2e-4, 3e-4),
                                  about(0, 0.02)};
    for (int i = 0; i < 5; ++i) rig.distortion[eye][i] = distortion[i];
  }
  const double baseline = about(140, 6);
  const double half_toe = std::atan(baseline / 2 / 560);
  rig.turn = {about(0.002, 0.005), 2 * half_toe + about(0, 0.005), about(0.003, 0.005)};
  const Point centre = {baseline * std::cos(half_toe), about(0.5, 1), baseline * std::sin(half_toe)};
  const Point moved = turned(rig.turn, centre);
  rig.shift_mm = {-moved[0], -moved[1], -moved[2]};
  return rig;
}

class HeldBoardCorners {
 public:
  HeldBoardCorners(const SimulatedRig& rig, const pipeline::BoardPattern& pattern, double noise_px,
                   unsigned seed)
      : rig_(rig), pattern_(pattern), noise_px_(noise_px), random_(seed) {}

  // Without corners where the camera does not see all of it, squares around the outer corners included.
  pipeline::BoardDetection seen(int eye, const BoardAt& at, double edge_px = 2) {
    pipeline::BoardDetection detection;
    for (int row = -1; row <= pattern_.rows; ++row)
      for (int column = -1; column <= pattern_.columns; ++column) {
        const Point p = in_camera(eye, place(at, column, row));
        const pipeline::Vec2d pixel = seen_by(rig_, eye, p);
        if (p[2] < 50 ||
            !(pixel.x > 1 && pixel.y > 1 && pixel.x < rig_.width_px - 2 && pixel.y < rig_.height_px - 2))
          return {};
        if (row < 0 || column < 0 || row == pattern_.rows || column == pattern_.columns) continue;
        detection.corners.push_back({pixel.x + normal(), pixel.y + normal()});
      }
    detection.edge_px = edge_px;
    return detection;
  }
  // A pair every tenth of a second.
  pipeline::PairDetection pair(const BoardAt& at) {
    now_ += std::chrono::milliseconds(100);
    return {{seen(0, at), seen(1, at)}, now_};
  }
  std::chrono::nanoseconds next_time() { return now_ += std::chrono::milliseconds(100); }

  // What the rig `found` makes of the pictures of true points, nine over a field of 160 mm at the
  // distance: root mean square of the errors in depth.
  double true_error_mm(const pipeline::StereoCalibration& found, double distance_mm) const {
    double sum = 0;
    for (int i = 0; i < 9; ++i) {
      const Point p = {(i % 3 - 1) * 80.0, (i / 3 - 1) * 80.0, distance_mm};
      const double off =
          depth_of(found, seen_by(rig_, 0, p), seen_by(rig_, 1, in_camera(1, p))) - distance_mm;
      sum += off * off / 9;
    }
    return std::sqrt(sum);
  }

 private:
  static Point ray(const pipeline::CameraIntrinsics& c, const pipeline::Vec2d& at) {
    const double u = (at.x - c.centre_px.x) / c.focal_px.x;
    const double v = (at.y - c.centre_px.y) / c.focal_px.y;
    const double* k = c.distortion;
    double x = u;
    double y = v;
    for (int i = 0; i < 60; ++i) {
      const double r2 = x * x + y * y;
      const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
      const double next = (u - 2 * k[2] * x * y - k[3] * (r2 + 2 * x * x)) / radial;
      y = (v - k[2] * (r2 + 2 * y * y) - 2 * k[3] * x * y) / radial;
      x = next;
    }
    return {x, y, 1};
  }
  // Of the point on the left line of sight that is nearest to the right one.
  static double depth_of(const pipeline::StereoCalibration& found, const pipeline::Vec2d& left,
                         const pipeline::Vec2d& right) {
    const pipeline::RigidTransform back = inverse(found.right_from_left);
    const Point a = ray(found.left, left);
    const Point r = ray(found.right, right);
    const pipeline::Vec3d b = apply(back.rotation, {r[0], r[1], r[2]});
    const pipeline::Vec3d c = back.translation_mm;
    const double aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    const double bb = b.x * b.x + b.y * b.y + b.z * b.z;
    const double ab = a[0] * b.x + a[1] * b.y + a[2] * b.z;
    const double ac = a[0] * c.x + a[1] * c.y + a[2] * c.z;
    const double bc = b.x * c.x + b.y * c.y + b.z * c.z;
    return (ac * bb - ab * bc) / (aa * bb - ab * ab);
  }
  Point place(const BoardAt& at, double column, double row) const {
    constexpr double kRad = 0.017453292519943295;
    Point p = {(column - 0.5 * (pattern_.columns - 1)) * pattern_.square_mm,
               (row - 0.5 * (pattern_.rows - 1)) * pattern_.square_mm, 0};
    p = turned({0, 0, at.roll_deg * kRad}, p);
    p = turned({at.pitch_deg * kRad, 0, 0}, p);
    p = turned({0, -at.yaw_deg * kRad, 0}, p);
    return {p[0] + at.right_mm, p[1] + at.down_mm, p[2] + at.distance_mm};
  }
  Point in_camera(int eye, const Point& p) const {
    if (eye == 0) return p;
    const Point q = turned(rig_.turn, p);
    return {q[0] + rig_.shift_mm[0], q[1] + rig_.shift_mm[1], q[2] + rig_.shift_mm[2]};
  }
  double normal() { return noise_px_ > 0 ? std::normal_distribution<double>(0, noise_px_)(random_) : 0; }

  SimulatedRig rig_;
  pipeline::BoardPattern pattern_;
  double noise_px_;
  std::mt19937 random_;
  std::chrono::nanoseconds now_{0};
};

}  // namespace relievo::tests
