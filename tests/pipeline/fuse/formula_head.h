// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A head of a formula, seen by rays: what a pose shows and where it stands are known to the last digit.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/fuse/pose_registration.h"
#include "pipeline/model/vector3.h"
#include "tests/pipeline/mesh/stage_room.h"

namespace relievo::pipeline {

inline constexpr int kColumns = 130, kRows = 150, kStepPx = 2;
inline constexpr double kFocalPx = 900, kSigmaMm = 0.05;

// The head turned about its upright axis, its middle 640 mm before the camera.
inline RigidTransform camera_from_head(double yaw_deg) {
  const double a = yaw_deg * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  RigidTransform out;
  out.rotation = product(Rotation{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, Rotation{{c, 0, s, 0, 1, 0, -s, 0, c}});
  const Vec3d middle{0, 20, -95};
  out.translation_mm = minus(Vec3d{0, 0, 640}, apply(out.rotation, middle));
  return out;
}

// Negative inside: an ellipsoid with waves of some millimetres; `moved_mm`: by how much the lower face stands
// out.
inline double shape(const Vec3d& p, double moved_mm) {
  const Vec3d q{p.x / 75, (p.y - 20) / 110, (p.z + 95) / 95};
  const double waves = 2.5 * std::sin(p.x / 11) * std::cos(p.y / 9) + 2 * std::sin((p.y + p.z) / 13);
  const double jaw =
      p.y < 10 && p.z > -60 ? moved_mm * std::sin((10 - p.y) / 25) * std::sin((p.z + 60) / 30) : 0;
  return (length(q) - 1) * 85 - waves - jaw;
}

// `further_mm`: by how much the camera stands further away than the first one.
inline Result<HeadPose> seen(double yaw_deg, double moved_mm, double further_mm, StageContext& context,
                             double sigma_mm = kSigmaMm) {
  RigidTransform camera = camera_from_head(yaw_deg);
  camera.translation_mm.z += further_mm;
  const RigidTransform head = inverse(camera);
  RectifiedPair pair(&context.scratch);
  pair.focal_px = kFocalPx;
  pair.left_centre_px = {kColumns * kStepPx / 2.0, kRows * kStepPx / 2.0};
  PointCloud cloud(&context.scratch);
  cloud.lattice_step_px = kStepPx;
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c) {
      const Vec2f px{static_cast<float>(c * kStepPx), static_cast<float>(r * kStepPx)};
      const Vec3d ray{(static_cast<double>(px.x) - pair.left_centre_px.x) / kFocalPx,
                      (static_cast<double>(px.y) - pair.left_centre_px.y) / kFocalPx, 1};
      const auto outside = [&](double z) { return shape(apply(head, times(ray, z)), moved_mm) > 0; };
      const double nearest = 500 + further_mm, furthest = 760 + further_mm;
      double far = nearest;
      while (far < furthest && outside(far)) far += 1;
      if (far >= furthest) continue;
      double near = far - 1;
      for (int k = 0; k < 40; ++k) (outside((near + far) / 2) ? near : far) = (near + far) / 2;
      const Vec3d at = times(ray, near);
      cloud.points.push_back({{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)},
                              px,
                              static_cast<float>(sigma_mm)});
    }
  RELIEVO_TRY_ASSIGN(HeadPose pose, make_head_pose(cloud, pair, context));
  pose.head_from_camera = head;
  pose.has_head = true;
  return pose;
}

class Poses : public ::testing::Test {
 protected:
  void show(std::initializer_list<std::pair<double, double>> yaw_and_moved, double others_further_mm = 0) {
    for (const auto& [yaw, moved] : yaw_and_moved) {
      const double further_mm = poses_.empty() ? 0 : others_further_mm;
      auto pose = room_.run([yaw = yaw, moved = moved, further_mm](StageContext& c) {
        return seen(yaw, moved, further_mm, c);
      });
      ASSERT_TRUE(pose) << pose.error().what.view();
      poses_.push_back(*std::move(pose));
    }
  }
  Result<Registration> registered() {
    return room_.run([this](StageContext& c) { return register_poses(poses_, c); });
  }
  StageRoom room_;
  std::vector<HeadPose> poses_;
};

}  // namespace relievo::pipeline
