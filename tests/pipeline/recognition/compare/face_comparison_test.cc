// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces compared whose difference is known: the same simulated head moved, turned and measured again, other
// heads, and half a millimetre put on by hand.
#include "tests/support/recognition/face_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

using test::heap;

struct Seen {
  RigidFace face{heap()};
  RigidTransform head_from_model;  // of the simulated head's own axes
};

Seen see(std::uint32_t seed, double yaw_deg, StageRoom& room) {
  const FieldHead head(seed);
  hal::sim::HeadPose pose;
  pose.yaw_deg = yaw_deg;
  const PointCloud cloud = head.cloud(pose, room.pool);
  const auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  const auto frame = room.run([&](StageContext& c) { return find_head_frame(*mesh, c); });
  EXPECT_TRUE(frame);
  const RigidTransform camera_from_model = FieldHead::camera_from_head(pose), &f = frame->head_from_camera;
  RigidTransform both;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      both.rotation.m[3 * i + j] = 0;
      for (int k = 0; k < 3; ++k)
        both.rotation.m[3 * i + j] += f.rotation.m[3 * i + k] * camera_from_model.rotation.m[3 * k + j];
    }
  both.translation_mm = apply(f, camera_from_model.translation_mm);
  return {rigid_face_of(*mesh, f, heap(), heap()), both};
}

ComparableFace comparable(const RigidFace& face) {
  auto made = ComparableFace::make(face);
  EXPECT_TRUE(made);
  return *std::move(made);
}

FaceDifference compared(const RigidFace& a, const RigidFace& b) {
  const auto d = compare_faces(comparable(a), comparable(b));
  EXPECT_TRUE(d);
  return d ? *d : FaceDifference{};
}

Vec3f moved(const RigidTransform& t, const Vec3f& p) {
  const Vec3d q = apply(t, {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
}

RigidFace moved(RigidFace face, const RigidTransform& t) {
  for (Vec3f& p : face.points_mm) p = moved(t, p);
  for (Vec3f& n : face.normals) n = moved({t.rotation, {}}, n);
  return face;
}

TEST(FaceComparison, TheSameHeadTurnedIsNearerThanAnyOther) {
  RELIEVO_MANY_TRIALS();
  StageRoom room;
  const Seen straight = see(3, 0, room), turned = see(3, 25, room);
  const FaceDifference same = compared(straight.face, turned.face);
  EXPECT_LT(same.rms_mm, 0.2) << "noise of 0.1 mm along the ray, in both";
  EXPECT_GT(same.shared, 0.6);
  for (const std::uint32_t other : {4U, 9U}) {
    const Seen someone = see(other, 0, room);
    EXPECT_GT(compared(someone.face, turned.face).rms_mm, 2 * same.rms_mm) << other;
    EXPECT_GT(compared(someone.face, straight.face).rms_mm, 2 * same.rms_mm) << other;
  }
  // The motion found takes one frame's numbers of a place to the other's.
  for (const Vec3d& p : {Vec3d{0, -10, 115}, Vec3d{40, 20, 70}, Vec3d{-30, 60, 90}}) {
    const Vec3d a = apply(same.b_from_a, apply(straight.head_from_model, p)),
                b = apply(turned.head_from_model, p);
    EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.15);
  }
}

// One head, straight ahead: looked at once for all tests.
const RigidFace& straight_face() {
  static const RigidFace face = [] {
    StageRoom room;
    return see(3, 0, room).face;
  }();
  return face;
}

TEST(FaceComparison, FramesThatAreOffAndTheOrderOfTheTwoDoNotMatter) {
  const RigidFace& face = straight_face();
  const double a = 0.07;
  const RigidTransform off{{{std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1}},
                           {2, -3, 2.5}};
  const RigidFace shifted = moved(face, off);
  const FaceDifference there = compared(face, shifted), back = compared(shifted, face);
  EXPECT_LT(there.rms_mm, 0.01);
  EXPECT_NEAR(back.rms_mm, there.rms_mm, 0.01);
  EXPECT_NEAR(there.b_from_a.translation_mm.y, -3, 0.02);
  EXPECT_NEAR(there.b_from_a.rotation.m[3], std::sin(a), 3e-4);
}

// Noise of s along the normals of both: their difference has s * sqrt 2, of which the middle nine tenths are
// kept.
TEST(FaceComparison, TheDifferenceOfTwoNoisySurfacesIsTheirNoise) {
  const RigidFace& face = straight_face();
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.3F);
  RigidFace a = face, b = face;
  for (RigidFace* f : {&a, &b})
    for (std::size_t i = 0; i < face.points_mm.size(); ++i) {
      const float s = noise(random);
      const Vec3f n = face.normals[i];
      f->points_mm[i] = {f->points_mm[i].x + s * n.x, f->points_mm[i].y + s * n.y,
                         f->points_mm[i].z + s * n.z};
    }
  // Of a normal distribution the nine tenths nearest to zero have 0.79 of its deviation (the integral of x^2
  // between +-1.64).
  EXPECT_NEAR(compared(a, b).rms_mm, 0.3 * std::sqrt(2.0) * 0.79, 0.04);
}

TEST(FaceComparison, SurfaceThatDoesNotOverlapIsNoComparison) {
  const RigidFace& face = straight_face();
  RigidFace left(heap()), right(heap());
  for (std::size_t i = 0; i < face.points_mm.size(); ++i) {
    if (std::abs(face.points_mm[i].x) < 8) continue;
    RigidFace& half = face.points_mm[i].x > 0 ? left : right;
    half.points_mm.push_back(face.points_mm[i]);
    half.normals.push_back(face.normals[i]);
    half.rim.push_back(face.rim[i]);
  }
  const auto none = compare_faces(comparable(left), comparable(right));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Errc::PoorGeometry);
  EXPECT_FALSE(ComparableFace::make(RigidFace(heap())));
}

TEST(RigidFace, HoldsMeasuredSurfaceOfTheRegionOnly) {
  const RigidFace& face = straight_face();
  EXPECT_GT(face.points_mm.size(), 2500u);
  for (const Vec3f& p : face.points_mm)
    EXPECT_TRUE(in_rigid_region(static_cast<double>(p.x), static_cast<double>(p.y)));
  EXPECT_TRUE(in_rigid_region(0, 30)) << "root of the nose";
  EXPECT_TRUE(in_rigid_region(-45, 15)) << "cheekbone";
  EXPECT_FALSE(in_rigid_region(32, 33)) << "eye";
  EXPECT_FALSE(in_rigid_region(0, -30)) << "mouth";
  EXPECT_FALSE(in_rigid_region(35, -5)) << "lower cheek";
  EXPECT_TRUE(rigid_face_of(FaceMesh(heap()), {}, heap(), heap()).points_mm.empty());
}

TEST(NearestPoints, AgreesWithLookingAtThemAll) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-50, 50);
  std::vector<Vec3f> points(2000);
  for (Vec3f& p : points) p = {place(random), place(random), place(random)};
  const NearestPoints tree(points);
  for (int i = 0; i < 500; ++i) {
    const Vec3f at{place(random), place(random), place(random)};
    const auto far = [&](const Vec3f& p) {
      return (p.x - at.x) * (p.x - at.x) + (p.y - at.y) * (p.y - at.y) + (p.z - at.z) * (p.z - at.z);
    };
    const std::uint32_t found =
        tree.nearest({static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)});
    for (const Vec3f& p : points) ASSERT_LE(far(points[found]), far(p) + 1e-4F);
  }
}

}  // namespace
}  // namespace relievo::pipeline
