// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

Rotation turned(double yaw_deg, double pitch_deg, double roll_deg) {
  const double a = yaw_deg * kDeg, b = pitch_deg * kDeg, c = roll_deg * kDeg;
  const Rotation y{{std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a)}};
  const Rotation x{{1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b)}};
  const Rotation z{{std::cos(c), -std::sin(c), 0, std::sin(c), std::cos(c), 0, 0, 0, 1}};
  const auto times = [](const Rotation& l, const Rotation& r) {
    Rotation product;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        product.m[3 * i + j] = 0;
        for (int k = 0; k < 3; ++k) product.m[3 * i + j] += l.m[3 * i + k] * r.m[3 * k + j];
      }
    return product;
  };
  return times(y, times(x, z));
}

double angle_between_deg(const Rotation& a, const Rotation& b) {
  double trace = 0;
  for (int i = 0; i < 9; ++i) trace += a.m[i] * b.m[i];
  return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) / kDeg;
}

void move(FaceMesh& mesh, const RigidTransform& motion) {
  const auto f = [](const Vec3d& v) {
    return Vec3f{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  for (Vec3f& v : mesh.vertices_mm) v = f(apply(motion, Vec3d{double(v.x), double(v.y), double(v.z)}));
  for (Vec3f& n : mesh.normals) n = f(apply(motion.rotation, Vec3d{double(n.x), double(n.y), double(n.z)}));
}

// Turns the mesh about its own middle, so that it stays in front of the camera.
RigidTransform about_the_face(const FaceMesh& mesh, const Rotation& rotation, const Vec3d& shift) {
  Vec3d middle;
  for (const Vec3f& v : mesh.vertices_mm) {
    middle.x += double(v.x) / double(mesh.vertices_mm.size());
    middle.y += double(v.y) / double(mesh.vertices_mm.size());
    middle.z += double(v.z) / double(mesh.vertices_mm.size());
  }
  const Vec3d r = apply(rotation, middle);
  return {rotation, {middle.x - r.x + shift.x, middle.y - r.y + shift.y, middle.z - r.z + shift.z}};
}

// An egg with a nose, a brow and a chin, mirror-like in x = 0; its tip is foremost at (0, 0).
// `neck_mm`: below y = 75 the surface lies so far behind the chin.
PointCloud egg_head(double nose_mm = 26, double chin_mm = 6, double neck_mm = 0) {
  return formula_cloud(2, 420, [=](double sx, double sy) {
    const double x = 520 * sx;
    const double y = 520 * sy;
    const double r = (x / 78) * (x / 78) + ((y + 5) / 105) * ((y + 5) / 105);
    if (r > 0.98) return std::numeric_limits<double>::quiet_NaN();
    const double skull = 85 * (1 - std::sqrt(1 - r));
    const auto bump = [](double u, double v) { return std::exp(-u * u - v * v); };
    const double nose = nose_mm * bump(x / 14, y / (y < 0 ? 30 : 10));
    const double chin = chin_mm * bump(x / 20, (y - 65) / 15);
    const double neck = y > 75 ? neck_mm * std::min(1.0, (y - 75) / 6) : 0;
    const double eyes = -6 * (bump((x - 32) / 13, (y + 38) / 10) + bump((x + 32) / 13, (y + 38) / 10));
    return 520 + skull - nose - chin - eyes + neck;
  });
}

FaceMesh mesh_of(const PointCloud& cloud, StageRoom& room) {
  GridMesher whole;  // to the horizon: where the mesher ends a face is not the question here
  whole.max_rim_deg = 90;
  auto mesh = room.run([&](StageContext& c) { return GridMesher(whole).mesh(cloud, c); });
  EXPECT_TRUE(mesh);
  return *std::move(mesh);
}

Result<HeadFrame> frame_of(const FaceMesh& mesh, StageRoom& room) {
  return room.run([&](StageContext& c) { return find_head_frame(mesh, c); });
}

// The frame must move with the head: frame_after = frame_before * motion^-1.
void expect_follows(const FaceMesh& mesh, StageRoom& room, double yaw, double pitch, double roll) {
  const auto before = frame_of(mesh, room);
  ASSERT_TRUE(before);
  FaceMesh moved = mesh;
  const RigidTransform motion = about_the_face(mesh, turned(yaw, pitch, roll), {12, -7, 30});
  move(moved, motion);
  const auto after = frame_of(moved, room);
  ASSERT_TRUE(after);
  const Vec3d tip = apply(inverse(before->head_from_camera), Vec3d{});
  const Vec3d tip_after = apply(after->head_from_camera, apply(motion, tip));
  EXPECT_LT(std::hypot(tip_after.x, tip_after.y, tip_after.z), 1) << yaw << " " << pitch << " " << roll;
  // Axes: what the old frame calls x, y, z, seen in the new one.
  Rotation axes;
  for (int k = 0; k < 3; ++k) {
    const Vec3d unit{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    const Vec3d seen =
        apply(after->head_from_camera.rotation,
              apply(motion.rotation, apply(transposed(before->head_from_camera.rotation), unit)));
    axes.m[k] = seen.x;
    axes.m[3 + k] = seen.y;
    axes.m[6 + k] = seen.z;
  }
  EXPECT_LT(angle_between_deg(axes, Rotation{}), 1) << yaw << " " << pitch << " " << roll;
}

TEST(HeadFrame, OriginAtTheTipAxesLikeThePerson) {
  StageRoom room;
  const auto frame = frame_of(mesh_of(egg_head(), room), room);
  ASSERT_TRUE(frame);
  const Vec3d tip = apply(inverse(frame->head_from_camera), Vec3d{});
  EXPECT_NEAR(tip.x, 0, 0.7);
  EXPECT_NEAR(tip.y, 0, 8);  // foremost in the head's own attitude, not the camera's
  EXPECT_NEAR(tip.z, 494, 1.5);
  const Rotation& r = frame->head_from_camera.rotation;
  EXPECT_GT(r.m[0], std::cos(1 * kDeg)) << "x: the person's left, the picture's right";
  EXPECT_LT(r.m[4], -0.85) << "y: up";
  EXPECT_LT(r.m[8], -0.9) << "z: out of the face";
  EXPECT_GT(frame->nose_relief_mm, 15);
  EXPECT_LT(frame->asymmetry_mm, 0.3);
  EXPECT_NEAR(frame->width_mm, 165, 12);
}

TEST(HeadFrame, FollowsAHeadThatTurns) {
  StageRoom room;
  const FaceMesh mesh = mesh_of(egg_head(), room);
  for (const auto& [yaw, pitch, roll] : {std::array{20.0, 0.0, 0.0},
                                         {-20.0, 0.0, 0.0},
                                         {0.0, 15.0, 0.0},
                                         {0.0, -15.0, 0.0},
                                         {0.0, 0.0, 12.0},
                                         {15.0, 8.0, -9.0}})
    expect_follows(mesh, room, yaw, pitch, roll);
}

// Over a neck a chin stands out further than a small nose does; but a face lies above it and next to nothing
// below.
TEST(HeadFrame, AChinOverANeckIsNoNose) {
  StageRoom room;
  const auto frame = frame_of(mesh_of(egg_head(14, 22, 40), room), room);
  ASSERT_TRUE(frame);
  const Vec3d tip = apply(inverse(frame->head_from_camera), Vec3d{});
  EXPECT_NEAR(tip.x, 0, 1.5);
  EXPECT_NEAR(tip.y, 0, 20) << "the chin is at 65";
}

TEST(HeadFrame, RotationIsProper) {
  StageRoom room;
  const auto frame = frame_of(mesh_of(egg_head(), room), room);
  ASSERT_TRUE(frame);
  const Rotation& r = frame->head_from_camera.rotation;
  EXPECT_LT(angle_between_deg(r, r), 1e-4);
  const double det = r.m[0] * (r.m[4] * r.m[8] - r.m[5] * r.m[7]) -
                     r.m[1] * (r.m[3] * r.m[8] - r.m[5] * r.m[6]) +
                     r.m[2] * (r.m[3] * r.m[7] - r.m[4] * r.m[6]);
  EXPECT_NEAR(det, 1, 1e-9);
}

TEST(HeadFrame, APhotoOnPaperHasNoNose) {
  StageRoom room;
  const auto frame =
      frame_of(mesh_of(formula_cloud(2, 400, [](double, double) { return 520.0; }), room), room);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, Errc::PoorGeometry);
}

TEST(HeadFrame, EmptyCancelledAndTinyArena) {
  StageRoom room;
  const FaceMesh empty(std::pmr::get_default_resource());
  const auto none = frame_of(empty, room);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Errc::PoorGeometry);
  const FaceMesh mesh = mesh_of(egg_head(), room);
  StageRoom measure;
  ASSERT_TRUE(frame_of(mesh, measure));
  const std::size_t need = measure.scratch.high_water();
  for (std::size_t step = 0; step < 12; ++step) {
    StageRoom tiny(1024, need * step / 12);
    const auto result = frame_of(mesh, tiny);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, Errc::OutOfMemory);
  }
  room.cancelled = true;
  const auto cancelled = frame_of(mesh, room);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, Errc::Cancelled);
}

TEST(HeadFrame, RenderedHeads) {
  for (const char* name : {"d1", "d2", "d3"}) {
    const auto dir = rendered_head(name);
    if (!dir) GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the rendered heads";
    StageRoom room(std::size_t{256} << 20);
    TruthOptions options;
    options.noise_mm = 0.08;
    const PointCloud cloud = truth_cloud(*dir, options);
    const FaceMesh mesh = mesh_of(cloud, room);
    const auto frame = frame_of(mesh, room);
    ASSERT_TRUE(frame);
    // The left camera stands about 7 degrees to the head's side; d2 is turned as well.
    const Rotation& r = frame->head_from_camera.rotation;
    EXPECT_GT(r.m[0], std::cos(30 * kDeg));
    EXPECT_LT(r.m[4], -std::cos(20 * kDeg));
    EXPECT_GT(frame->nose_relief_mm, 20) << name;
    EXPECT_LT(frame->nose_relief_mm, 45) << name;
    // The foremost measured points of a face held upright belong to its nose.
    Vec3f front{0, 0, 1e9F};
    for (const CloudPoint& p : cloud.points)
      if (p.at_mm.z < front.z) front = p.at_mm;
    const Vec3d seen =
        apply(frame->head_from_camera, Vec3d{double(front.x), double(front.y), double(front.z)});
    EXPECT_LT(std::hypot(seen.x, seen.y, seen.z), 12) << name;
    for (const double yaw : {-10.0, 8.0}) expect_follows(mesh, room, yaw, 5, -6);
  }
}

}  // namespace
}  // namespace relievo::pipeline
