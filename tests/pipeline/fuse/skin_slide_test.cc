// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A painted ball, seen by rays: turned about its middle it has the same shape, or nearly, and its skin tells.
#include "pipeline/fuse/pose_residuals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

#include "pipeline/model/vector3.h"
#include "tests/pipeline/mesh/stage_room.h"

namespace relievo::pipeline {
namespace {

constexpr int kColumns = 150, kRows = 150, kStepPx = 2;
constexpr double kFocalPx = 1500, kRadiusMm = 90, kAwayMm = 640;

RigidTransform camera_from_ball(double yaw_deg) {
  const double a = yaw_deg * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  RigidTransform out;
  out.rotation = product(Rotation{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, Rotation{{c, 0, s, 0, 1, 0, -s, 0, c}});
  out.translation_mm = {0, 0, kAwayMm};
  return out;
}

double paint(const Vec3d& p) {
  return 120 + 12 * std::sin(p.x / 1.3 + p.y / 3) * std::cos(p.y / 1.7) + 15 * std::sin(p.y / 5 + p.x / 7) +
         10 * std::sin(p.x / 2.9) * std::sin(p.z / 2.3);
}

// Where the ball stands out, and where it does while it makes a face.
double bump_mm(const Vec3d& p, double face_mm) {
  return 0.5 * std::sin(p.x / 12) * std::cos(p.y / 14) + 0.5 * std::sin((p.y + p.z) / 15) +
         face_mm * std::sin(p.x / 17 + p.y / 15);
}

class PaintedBall : public ::testing::Test {
 protected:
  // `light`: what the photograph shows of the paint.
  HeadPose seen(double yaw_deg, double light = 1, double contrast = 1, std::optional<double> face_mm = {}) {
    const RigidTransform ball_from_camera = inverse(camera_from_ball(yaw_deg));
    const int width = kColumns * kStepPx, height = kRows * kStepPx;
    std::vector<std::uint8_t> photo(std::size_t(3 * width * height), 20);
    auto pose = room_.run([&](StageContext& context) {
      RectifiedPair pair(&context.scratch);
      pair.focal_px = kFocalPx;
      pair.left_centre_px = {width / 2.0, height / 2.0};
      PointCloud cloud(&context.scratch);
      cloud.lattice_step_px = kStepPx;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const Vec3d ray{(x - pair.left_centre_px.x) / kFocalPx, (y - pair.left_centre_px.y) / kFocalPx, 1};
          const double b = kAwayMm / dot(ray, ray);
          const double inside = b * b - (kAwayMm * kAwayMm - kRadiusMm * kRadiusMm) / dot(ray, ray);
          if (inside < 0) continue;
          const double on_ball = b - std::sqrt(inside);
          Vec3d at = times(ray, on_ball);
          const auto below = [&] { return times(unit(apply(ball_from_camera, at)), kRadiusMm); };
          const double slant = std::max(std::sqrt(inside * dot(ray, ray)) / kRadiusMm, 0.2) * length(ray);
          for (int k = 0; face_mm && k < 3; ++k)
            at = times(ray, on_ball - bump_mm(below(), *face_mm) / slant);
          const double shown = light * (120 + contrast * (paint(below()) - 120));
          for (std::size_t c = 0; c < 3; ++c)
            photo[std::size_t(3 * (y * width + x)) + c] = std::uint8_t(std::lround(shown));
          if (x % kStepPx == 0 && y % kStepPx == 0)
            cloud.points.push_back({narrow(at), {float(x), float(y)}, 0.05F});
        }
      return make_head_pose(cloud, pair, context);
    });
    pose->left_rgb.assign(photo.begin(), photo.end());
    pose->width_px = width;
    pose->height_px = height;
    return *std::move(pose);
  }

  // How far off the same skin is found, at worst, and how often it is.
  static std::pair<double, int> worst_of(const HeadPose& from, const HeadPose& to, double yaw_deg,
                                         double start_deg) {
    const RigidTransform truth = product(camera_from_ball(yaw_deg), inverse(camera_from_ball(0)));
    const RigidTransform start = product(camera_from_ball(start_deg), inverse(camera_from_ball(0)));
    std::pair<double, int> worst{0, 0};
    for (double x = -40; x <= 40; x += 10)
      for (double y = -40; y <= 40; y += 10) {
        const Vec3d normal = unit(Vec3d{x, y, std::sqrt(kRadiusMm * kRadiusMm - x * x - y * y)});
        const RigidTransform camera = camera_from_ball(0);
        const Vec3d place = apply(camera, times(normal, kRadiusMm));
        const Vec3d up = unit(minus(Vec3d{0, 1, 0}, times(normal, normal.y))), right = cross(up, normal);
        const auto found =
            same_skin(from, place, {apply(camera.rotation, right), apply(camera.rotation, up)}, to, start);
        if (!found) continue;
        worst.first = std::max(worst.first, distance(*found, apply(truth, place)));
        ++worst.second;
      }
    return worst;
  }

  StageRoom room_;
};

TEST_F(PaintedBall, ShowsTheSameSkinAlsoInOtherLight) {
  const auto [off_mm, count] = worst_of(seen(0), seen(20, 0.7), 20, 20.4);  // starts 0.6 mm off
  EXPECT_GT(count, 40);
  EXPECT_LT(off_mm, 0.14) << "a third of a pixel";
}

TEST_F(PaintedBall, SaysNothingWhereThereIsNothingToSee) {
  EXPECT_EQ(worst_of(seen(0, 1, 0), seen(20), 20, 20).second, 0) << "no paint";
  EXPECT_EQ(worst_of(seen(0), seen(20, 1, 0), 20, 20).second, 0) << "none in the other photograph";
}

TEST_F(PaintedBall, IsRegisteredBetterByItsSkin) {
  constexpr double kYawDeg = 15, kStartsOffDeg = 1.5;
  const HeadPose front = seen(0, 1, 1, 0), side = seen(kYawDeg, 1, 1, 0.5);
  const RigidTransform head_from_ball{{}, {0, 20, -95}};
  const auto degrees_off = [&](bool with_photographs) {
    std::vector<HeadPose> poses{front, side};
    poses[0].head_from_camera = product(head_from_ball, inverse(camera_from_ball(0)));
    poses[1].head_from_camera = product(head_from_ball, inverse(camera_from_ball(kYawDeg - kStartsOffDeg)));
    for (HeadPose& pose : poses) {
      pose.has_head = true;
      if (!with_photographs) pose.left_rgb.clear();
    }
    const auto found = room_.run([&](StageContext& c) { return register_poses(poses, c); });
    if (!found) return 180.0;
    const Rotation truth =
        product(camera_from_ball(0).rotation, transposed(camera_from_ball(kYawDeg).rotation));
    double trace = 0;
    for (std::size_t i = 0; i < 9; ++i) trace += truth.m[i] * found->poses[1].first_from_pose.rotation.m[i];
    return std::acos(std::min(1.0, (trace - 1) / 2)) * 180 / std::numbers::pi;
  };
  const double by_shape = degrees_off(false), by_skin = degrees_off(true);
  std::printf("by shape alone %.3f, with the skin %.3f degrees off\n", by_shape, by_skin);
  EXPECT_GT(by_shape, 5 * by_skin);
  EXPECT_LT(by_skin, 0.3);
}

}  // namespace
}  // namespace relievo::pipeline
