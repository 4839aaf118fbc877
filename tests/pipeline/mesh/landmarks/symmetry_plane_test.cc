// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/symmetry_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "tests/pipeline/mesh/stage_room.h"

namespace relievo::pipeline {
namespace {

using Eigen::Vector3d;
double height_mm(double x, double y) {
  const auto bump = [](double u, double v) { return std::exp(-u * u - v * v); };
  return -x * x / 160 - y * y / 260 + 24 * bump(x / 13, y / 22) -
         6 * (bump((x - 30) / 12, (y - 30) / 9) + bump((x + 30) / 12, (y - 30) / 9));
}

// A face seen from 60 mm on one side of the nose to `far_mm` on the other, turned about y, each point off by
// `rough_mm` and its normal with it (a bad match).
std::vector<SurfacePoint> face(double yaw_deg, double far_mm, double rough_mm, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(yaw_deg * kDeg, Vector3d::UnitY()).toRotationMatrix();
  std::vector<SurfacePoint> points;
  for (double y = -80; y <= 80; y += 2)
    for (double x = -60; x <= far_mm; x += 2) {
      const double noise = rough_mm * normal(random);
      const Vector3d slope{(height_mm(x + 1, y) - height_mm(x - 1, y)) / 2 + 0.3 * rough_mm * normal(random),
                           (height_mm(x, y + 1) - height_mm(x, y - 1)) / 2 + 0.3 * rough_mm * normal(random),
                           0};
      points.push_back({turn * Vector3d{x, y, height_mm(x, y) - 24 + noise},
                        turn * Vector3d{-slope.x(), -slope.y(), 1}.normalized()});
    }
  return points;
}

double off_deg(const SymmetryPlane& plane, double yaw_deg) {
  const Vector3d truth{std::cos(yaw_deg * kDeg), 0, -std::sin(yaw_deg * kDeg)};
  return std::acos(std::clamp(plane.normal.dot(truth), -1.0, 1.0)) / kDeg;
}

TEST(SymmetryPlane, IsFoundToHalfADegreeOnASmoothFace) {
  for (const double yaw : {-20.0, 0.0, 13.0}) {
    StageRoom room;
    const auto points = face(yaw, 60, 0, 1);
    const auto plane = room.run([&](StageContext& c) { return find_symmetry_plane(points, c); });
    ASSERT_TRUE(plane);
    EXPECT_LT(off_deg(*plane, yaw), 0.5) << yaw;
    EXPECT_LT(plane->residual_mm, 0.3) << yaw;
  }
}

// The descent may leave a rough surface for where hardly anything meets: what was nearer the truth before
// must stay, or nothing be found.
TEST(SymmetryPlane, ARoughSurfaceHasNoPlaneRatherThanAWrongOne) {
  for (const double far_mm : {15.0, 25.0})
    for (const double yaw : {-25.0, 0.0, 18.0})
      for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        StageRoom room;
        const auto points = face(yaw, far_mm, 4, seed);
        const auto plane = room.run([&](StageContext& c) { return find_symmetry_plane(points, c); });
        EXPECT_LT(plane ? off_deg(*plane, yaw) : 0, 5)
            << "seen to " << far_mm << " mm, yaw " << yaw << ", seed " << seed;
      }
}

}  // namespace
}  // namespace relievo::pipeline
