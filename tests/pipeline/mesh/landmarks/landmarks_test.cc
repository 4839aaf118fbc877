// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames and landmarks of simulated heads against what the heads know of themselves.
#include <gtest/gtest.h>

#include <initializer_list>
#include <numbers>
#include <vector>

#include "pipeline/mesh/landmarks/face_profile.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/landmarks/landmark_finder.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

using hal::sim::HeadPose;

struct Look {
  RigidTransform true_head_from_camera, head_from_camera;
  Landmarks landmarks;
};

Look look_at(const FieldHead& head, double yaw_deg, double pitch_deg, StageRoom& room) {
  HeadPose pose;
  pose.yaw_deg = yaw_deg;
  pose.pitch_deg = pitch_deg;
  const PointCloud cloud = head.cloud(pose, room.pool);
  const auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  EXPECT_TRUE(mesh);
  const auto frame = room.run([&](StageContext& c) { return find_head_frame(*mesh, c); });
  EXPECT_TRUE(frame);
  const auto landmarks =
      room.run([&](StageContext& c) { return find_landmarks(*mesh, frame->head_from_camera, {}, c); });
  EXPECT_TRUE(landmarks);
  return {inverse(FieldHead::camera_from_head(pose)), frame->head_from_camera, *landmarks};
}

// What one frame calls a point, the other calls by the same numbers.
void expect_same_frame(const Look& a, const Look& b) {
  const auto in_b = [&](const Vec3d& p) {
    const Vec3d body = apply(a.true_head_from_camera, apply(inverse(a.head_from_camera), p));
    return apply(b.head_from_camera, apply(inverse(b.true_head_from_camera), body));
  };
  const Vec3d o = in_b({});
  EXPECT_LT(std::hypot(o.x, o.y, o.z), 0.7);
  for (const Vec3d& axis : {Vec3d{100, 0, 0}, Vec3d{0, 100, 0}, Vec3d{0, 0, 100}}) {
    const Vec3d p = in_b(axis);
    EXPECT_LT(std::hypot(p.x - o.x - axis.x, p.y - o.y - axis.y, p.z - o.z - axis.z),
              100 * 0.7 * std::numbers::pi / 180);
  }
}

TEST(Landmarks, TheFrameOfAHeadThatTurnsStaysWithin07) {
  RELIEVO_MANY_TRIALS();
  StageRoom room;
  for (const std::uint32_t seed : {3U}) {
    const FieldHead head(seed);
    std::vector<Look> looks;
    for (const auto& [yaw, pitch] :
         {std::pair{0.0, 0.0}, {25.0, 0.0}, {-25.0, 0.0}, {0.0, 15.0}, {0.0, -15.0}})
      looks.push_back(look_at(head, yaw, pitch, room));
    for (std::size_t i = 0; i < looks.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        SCOPED_TRACE(std::to_string(seed) + ": " + std::to_string(i) + " " + std::to_string(j));
        expect_same_frame(looks[i], looks[j]);
      }
  }
}

// Half a nose is a poor mirror; a chin or a forehead mirrors itself better, but does not stand out.
TEST(Landmarks, AHeadTurnedFarAwayKeepsItsNose) {
  StageRoom room;
  for (const std::uint32_t seed : {1002U}) {
    const FieldHead head(seed);
    const Look look = look_at(head, 37, 0, room);
    const Vec3d tip = apply(look.true_head_from_camera, apply(inverse(look.head_from_camera), Vec3d{}));
    for (const auto& [name, at] : hal::sim::landmarks_of(head.field())) {
      if (name != "pronasale") continue;
      EXPECT_LT(std::hypot(tip.x - at.x, tip.y - at.y, tip.z - at.z), 4) << seed;
    }
  }
}

TEST(Landmarks, LieWhereTheSigmaSays) {
  StageRoom room;
  int count = 0;
  double sum = 0;
  for (const std::uint32_t seed : {4U, 9U}) {
    const FieldHead head(seed);
    const Look look = look_at(head, 0, 0, room);
    const auto truth = hal::sim::landmarks_of(head.field());
    for (const auto& [name, at] : truth)
      for (std::size_t k = 0; k < kLandmarkCount; ++k) {
        if (word(static_cast<LandmarkName>(k)) != name) continue;
        const Landmark& l = look.landmarks[k];
        if (!l.found && name.starts_with("exocanthion"))
          continue;  // this head has no eyeballs: a hole where they are
        ASSERT_TRUE(l.found) << name;
        const Vec3d p =
            apply(look.true_head_from_camera, {double(l.at_mm.x), double(l.at_mm.y), double(l.at_mm.z)});
        const double off = std::hypot(p.x - at.x, p.y - at.y, p.z - at.z);
        EXPECT_LT(off, 4 * static_cast<double>(l.sigma_mm)) << seed << " " << name;
        sum += off * off / (3 * static_cast<double>(l.sigma_mm * l.sigma_mm));
        ++count;
      }
  }
  ASSERT_GE(count, 16);
  // One if the sigmas are right.
  EXPECT_GT(sum / count, 0.25);
  EXPECT_LT(sum / count, 1.5);
}

TEST(Landmarks, AreNotFoundWhereNothingWasMeasured) {
  StageRoom room;
  const FaceMesh nothing(std::pmr::get_default_resource());
  const auto landmarks = room.run([&](StageContext& c) { return find_landmarks(nothing, {}, {}, c); });
  ASSERT_TRUE(landmarks);
  for (const Landmark& l : *landmarks) EXPECT_FALSE(l.found);
  room.cancelled = true;
  EXPECT_FALSE(room.run([&](StageContext& c) { return find_landmarks(nothing, {}, {}, c); }));
}

// Heights above the tip of the nose and depths of a profile, as polylines.
std::vector<ProfilePoint> profile_through(std::initializer_list<ProfilePoint> knots) {
  std::vector<ProfilePoint> profile;
  for (auto k = knots.begin(); k + 1 != knots.end(); ++k)
    for (double y = k->y_mm; y < (k + 1)->y_mm; y += 0.75) {
      const double t = (y - k->y_mm) / ((k + 1)->y_mm - k->y_mm);
      const double eased = t * t * (3 - 2 * t);
      profile.push_back({y, k->z_mm + eased * ((k + 1)->z_mm - k->z_mm)});
    }
  return profile;
}

TEST(Landmarks, TheLowerLipOfAnOpenMouthIsNoChin) {
  const auto shut = find_profile_marks(profile_through(
      {{-100, -60}, {-84, -36}, {-62, -40}, {-45, -28}, {-25, -22}, {0, 0}, {40, -25}, {80, -20}}));
  ASSERT_TRUE(shut.chin);
  EXPECT_NEAR(shut.chin->y_mm, -84, 2);
  const auto open = find_profile_marks(profile_through({{-103, -60},
                                                        {-90, -40.5},
                                                        {-75, -41.5},
                                                        {-60, -39},
                                                        {-48, -43},
                                                        {-30, -22},
                                                        {0, 0},
                                                        {40, -25},
                                                        {80, -20}}));
  ASSERT_TRUE(open.chin);
  EXPECT_NEAR(open.chin->y_mm, -90, 2);
  // What stands far behind the lip is the throat.
  const auto throat = find_profile_marks(profile_through({{-103, -58},
                                                          {-96, -55},
                                                          {-90, -60},
                                                          {-80, -36},
                                                          {-60, -40},
                                                          {-42, -28},
                                                          {-25, -22},
                                                          {0, 0},
                                                          {40, -25},
                                                          {80, -20}}));
  ASSERT_TRUE(throat.chin);
  EXPECT_NEAR(throat.chin->y_mm, -80, 2);
}

// The throat, or a chin that leans back from the lips to the neck.
TEST(Landmarks, AChinThatHardlyStandsOutIsFound) {
  const auto throat = find_profile_marks(profile_through(
      {{-90, -60}, {-66, -22}, {-55, -24}, {-43, -17}, {-25, -16}, {0, 0}, {40, -25}, {80, -20}}));
  ASSERT_TRUE(throat.chin);
  EXPECT_FALSE(throat.chin_recedes);
  EXPECT_NEAR(throat.chin->y_mm, -66, 2);
  const auto recedes = find_profile_marks(profile_through(
      {{-90, -70}, {-64, -29}, {-52, -26.5}, {-43, -18}, {-25, -15}, {0, 0}, {40, -25}, {80, -20}}));
  ASSERT_TRUE(recedes.chin);
  EXPECT_TRUE(recedes.chin_recedes);
  EXPECT_NEAR(recedes.chin->y_mm, -64, 3);
  // A profile that ends before its chin shows none.
  EXPECT_FALSE(
      find_profile_marks(
          profile_through({{-60, -29}, {-52, -26.5}, {-43, -18}, {-25, -15}, {0, 0}, {40, -25}, {80, -20}}))
          .chin);
}

}  // namespace
}  // namespace relievo::pipeline
