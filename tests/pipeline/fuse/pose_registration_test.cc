// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/pose_registration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "pipeline/fuse/head_fuser.h"
#include "pipeline/fuse/pose_residuals.h"
#include "tests/pipeline/fuse/formula_head.h"
#include "tests/support/allocation_counter.h"

namespace relievo::pipeline {
namespace {

RigidTransform turned_by(const RigidTransform& t, double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  RigidTransform out = t;
  out.rotation =
      product(Rotation{{std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1}}, t.rotation);
  return out;
}

double degrees_off(const RegisteredPose& found, double yaw_deg) {
  const Rotation truth =
      product(camera_from_head(0).rotation, transposed(camera_from_head(yaw_deg).rotation));
  double trace = 0;
  for (std::size_t i = 0; i < 9; ++i) trace += truth.m[i] * found.first_from_pose.rotation.m[i];
  return std::acos(std::min(1.0, (trace - 1) / 2)) * 180 / std::numbers::pi;
}

TEST_F(Poses, ShowTheSurfaceWhereItIs) {
  show({{20, 0}});
  const HeadPose& pose = poses_[0];
  int hits = 0;
  for (double x = -60; x <= 60; x += 7)
    for (double y = -60; y <= 60; y += 7) {
      const auto hit = pose.look({static_cast<float>(x), static_cast<float>(y), 560});
      if (!hit) continue;
      ++hits;
      EXPECT_NEAR(shape(apply(pose.head_from_camera, wide(hit->at_mm)), 0), 0, 0.06) << x << " " << y;
      EXPECT_LT(dot(hit->normal, unit(hit->at_mm)), 0) << "towards the camera";
      EXPECT_LE(hit->sigma_mm, kSigmaMm + 1e-6);
      EXPECT_GT(hit->trust, 0);
    }
  EXPECT_GT(hits, 150);
  EXPECT_FALSE(pose.look({300, 0, 560})) << "beside the head";
  EXPECT_FALSE(pose.look({0, 0, -100})) << "behind the camera";
}

// Cameras of few pixels: skin is no hair because all of it is unsure.
TEST_F(Poses, KeepWhatIsAsUnsureAsAllOfThem) {
  const auto trusted = [this](double sigma_mm) {
    const auto pose = room_.run([&](StageContext& c) { return seen(0, 0, 0, c, sigma_mm); });
    return pose ? std::ranges::count_if(
                      pose->nodes, [](float t) { return t > 0; }, &SurfaceHit::trust)
                : 0;
  };
  EXPECT_GT(trusted(kSigmaMm), 5000);
  EXPECT_EQ(trusted(2), trusted(kSigmaMm));
}

TEST_F(Poses, AreFoundFromAWrongStart) {
  show({{0, 0}, {-25, 0}, {25, 0}, {45, 0}});
  poses_[1].head_from_camera =
      turned_by(poses_[1].head_from_camera, 4);  // a head frame is a degree off at worst
  poses_[3].has_head = false;
  const auto found = registered();
  ASSERT_TRUE(found) << found.error().what.view() << " " << found.error().where();
  for (const auto& [k, yaw] : {std::pair<std::size_t, double>{1, -25}, {2, 25}, {3, 45}})
    EXPECT_LT(degrees_off(found->poses[k], yaw), 0.02) << yaw;
  EXPECT_EQ(found->poses[0].first_from_pose.translation_mm.x, 0);
}

TEST_F(Poses, AreTheSameWherePartOfTheWorkWasDoneBefore) {
  show({{0, 0}, {-25, 0.8}, {25, -0.8}, {45, 0}});
  poses_[3].has_head = false;  // must be looked for
  const auto at_once = registered();
  ASSERT_TRUE(at_once) << at_once.error().what.view();
  const auto places = [](const Registration& r) {
    std::vector<double> all;
    for (const RegisteredPose& p : r.poses) {
      for (const double x : p.first_from_pose.rotation.m) all.push_back(x);
      for (const double x : {p.first_from_pose.translation_mm.x, p.first_from_pose.translation_mm.y})
        all.push_back(x);
    }
    return all;
  };
  const std::vector<double> expected = places(*at_once);
  for (std::size_t count = 2; count <= poses_.size(); ++count)
    ASSERT_TRUE(room_.run([&](StageContext& c) -> Result<void> {
      place_last_pose(std::span(poses_).first(count), c);
      return {};
    }));
  ASSERT_TRUE(poses_[1].first_from_pose && poses_[2].first_from_pose && poses_[3].first_from_pose);
  EXPECT_LT(degrees_off({*poses_[1].first_from_pose}, -25), 1);
  EXPECT_LT(degrees_off({*poses_[3].first_from_pose}, 45), 1);
  const auto later = registered();
  ASSERT_TRUE(later) << later.error().what.view();
  EXPECT_EQ(places(*later), expected);
}

// All it works with is in the plan: 1 MB a pose came from the heap once.
TEST_F(Poses, TakeNothingFromTheHeap) {
  if (!AllocationCounter::counts()) GTEST_SKIP() << "a sanitizer has its own malloc";
  show({{0, 0}, {25, 0}});
  const AllocationCounter counter;
  const auto found = registered();
  EXPECT_EQ(counter.made(), 0);
  ASSERT_TRUE(found) << found.error().what.view();
}

TEST_F(Poses, AreFoundAlsoWhereOtherCamerasSawThem) {
  show({{0, 0}, {25, 0}}, 250);
  poses_[1].has_head = false;
  const auto found = registered();
  ASSERT_TRUE(found) << found.error().what.view() << " " << found.error().where();
  EXPECT_LT(degrees_off(found->poses[1], 25), 0.02);
}

TEST_F(Poses, AreNotMisledByTheFrameOfAnotherSide) {
  show({{0, 0}, {-25, 0}, {25, 0}, {45, 0}});
  poses_[3].head_from_camera = inverse(camera_from_head(-30));
  const auto found = registered();
  ASSERT_TRUE(found) << found.error().what.view() << " " << found.error().where();
  EXPECT_LT(degrees_off(found->poses[3], 45), 0.02);
}

TEST_F(Poses, AreNotTurnedByALowerFaceThatMoved) {
  show({{0, 0}, {-25, 0.8}, {25, -0.8}});
  const auto found = registered();
  ASSERT_TRUE(found) << found.error().what.view() << " " << found.error().where();
  EXPECT_LT(degrees_off(found->poses[1], -25), 0.1);
  EXPECT_LT(degrees_off(found->poses[2], 25), 0.1);
}

TEST(Skin, SaysAlikeHoweverWellItWasMeasuredWhereItMoves) {
  const auto counts = [](double weight, double mm, double usual_mm) {
    return weight * SkinPatches::say({0, 0, 1, mm, weight}, {usual_mm});
  };
  EXPECT_NEAR(counts(4e4, 0, 0) / counts(2e3, 0, 0), 20, 1e-9) << "skin that stands still: as measured";
  EXPECT_LT(counts(4e4, 0, 0.06) / counts(2e3, 0, 0.06), 1.2);
  EXPECT_LT(counts(2e3, 0.5, 0.06), 0.01 * counts(2e3, 0, 0.06)) << "what moved loses its say";
}

TEST_F(Poses, TellWhereTheyDisagree) {
  show({{0, 0}, {20, 0.8}, {-20, 0}});
  const auto found = registered();
  ASSERT_TRUE(found);
  const ResidualMap& map = found->residuals[1];
  ASSERT_EQ(map.mm.size(), static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
  double jaw = 0, truth = 0, count = 0;
  for (std::size_t i = 0; i < map.mm.size(); ++i) {
    if (std::isnan(map.mm[i])) continue;
    const std::size_t column = i % static_cast<std::size_t>(map.columns),
                      row = i / static_cast<std::size_t>(map.columns);
    const std::size_t node = kResidualEvery * (row * static_cast<std::size_t>(poses_[1].columns) + column);
    const Vec3d at = apply(poses_[1].head_from_camera, wide(poses_[1].nodes.at(node).at_mm));
    if (at.y > 50 && std::abs(at.x) < 40) {
      EXPECT_LT(std::abs(map.mm[i]), 0.05) << "the brow did not move";
    }
    if (at.y > -50 && at.y < -20 && at.z > -40 && std::abs(at.x) < 25) {
      jaw += static_cast<double>(map.mm[i]);
      truth += shape(at, 0);
      count += 1;
    }
  }
  ASSERT_GT(count, 20);
  EXPECT_GT(truth / count, 0.2);
  EXPECT_NEAR(jaw / truth, 1, 0.3) << "a moved jaw stands before where the others show it";
  const auto& meets = found->poses[0].meets;
  EXPECT_EQ(meets[0].overlap_mm2, 0) << "a pose is not compared with itself";
  EXPECT_GT(meets[1].overlap_mm2, 5000);
  EXPECT_NEAR(meets[1].overlap_mm2, found->poses[1].meets[0].overlap_mm2, 0.1 * meets[1].overlap_mm2);
  EXPECT_GT(meets[1].rms_mm, 3 * meets[2].rms_mm);
  EXPECT_GT(meets[1].p95_mm, meets[1].rms_mm);
}

TEST_F(Poses, AreBentToTheFirstWhereSkinMovedAndStayElsewhere) {
  show({{0, 0}, {20, 0.8}});
  auto found = registered();
  ASSERT_TRUE(found);
  const std::pmr::vector<SurfaceHit> first = poses_[0].nodes, before = poses_[1].nodes;
  ASSERT_TRUE(room_.run([&](StageContext& c) -> Result<void> {
    bend_to_master(poses_, *found, {.bend_width_mm = 8}, false, c);
    return {};
  }));
  double jaw_before = 0, jaw = 0, count = 0, brow = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (poses_[1].nodes[k].trust < 0.9F) continue;
    const Vec3d was = apply(poses_[1].head_from_camera, wide(before[k].at_mm));
    const Vec3d is = apply(poses_[1].head_from_camera, wide(poses_[1].nodes[k].at_mm));
    if (was.y > 50) brow = std::max(brow, distance(was, is));
    if (was.y > -50 && was.y < -20 && was.z > -40 && std::abs(was.x) < 25) {
      jaw_before += std::abs(shape(was, 0));
      jaw += std::abs(shape(is, 0));
      count += 1;
    }
  }
  ASSERT_GT(count, 100);
  EXPECT_GT(jaw_before / count, 0.2);
  EXPECT_LT(jaw, jaw_before / 3) << "what moved lies on the first one's surface";
  EXPECT_LT(brow, 0.05) << "what did not stays";
  EXPECT_EQ(distance(first[first.size() / 2].at_mm, poses_[0].nodes[first.size() / 2].at_mm), 0)
      << "the first never moves";
}

// What moved between the exposures of both lies further off than another surface may, and both know that they
// are unsure.
TEST_F(Poses, AreBentAsFarAsBothAreUnsure) {
  for (const auto& [yaw, moved] : {std::pair{0.0, 0.0}, {20.0, 4.5}}) {
    auto pose =
        room_.run([yaw = yaw, moved = moved](StageContext& c) { return seen(yaw, moved, 0, c, 1.5); });
    ASSERT_TRUE(pose);
    poses_.push_back(*std::move(pose));
  }
  Registration placed(std::pmr::get_default_resource());
  placed.poses.resize(2);
  placed.poses[1].first_from_pose = product(camera_from_head(0), inverse(camera_from_head(20)));
  const auto furthest_mm = [this] {  // of the jaw, from the first one's
    double most = 0;
    for (std::size_t k = 0; k < poses_[1].nodes.size(); ++k) {
      const Vec3d at = apply(poses_[1].head_from_camera, wide(poses_[1].nodes[k].at_mm));
      if (poses_[1].nodes[k].trust > 0.9F && at.y > -45 && at.y < -25 && at.z > -30 && std::abs(at.x) < 20)
        most = std::max(most, std::abs(shape(at, 0)));
    }
    return most;
  };
  const double before = furthest_mm();
  EXPECT_GT(before, 4);
  ASSERT_TRUE(room_.run([&](StageContext& c) -> Result<void> {
    bend_to_master(poses_, placed, {.bend_width_mm = 8}, false, c);
    return {};
  }));
  EXPECT_LT(furthest_mm(), 0.6 * before);
}

TEST_F(Poses, ThatMeetNothingAreNamed) {
  show({{0, 0}, {0, 0}});
  for (SurfaceHit& node : poses_[1].nodes) node.at_mm.z += 25 * std::sin(node.at_mm.x / 6);  // something else
  poses_[1].has_head = false;
  const auto found = registered();
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Errc::PoorGeometry);
  EXPECT_EQ(found.error().where(), "pair 2");
}

TEST_F(Poses, ThatFitNoneOfTheOthersAreLeftOut) {
  show({{0, 0}, {25, 0}, {-25, 0}});
  const auto both = registered();
  ASSERT_TRUE(both);
  show({{0, 0}, {25, 0}, {-25, 0}});
  for (SurfaceHit& node : poses_[1].nodes) node.at_mm.z += 25 * std::sin(node.at_mm.x / 6);  // something else
  const auto found = registered();
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->poses[0].joined);
  EXPECT_FALSE(found->poses[1].joined);
  EXPECT_TRUE(found->poses[2].joined);
  EXPECT_TRUE(std::ranges::all_of(
      poses_[1].nodes, [](float t) { return t == 0; }, &SurfaceHit::trust));
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(found->poses[2].first_from_pose.rotation.m[i], both->poses[2].first_from_pose.rotation.m[i],
                0.002);
}

TEST_F(Poses, NeedAHeadInTheFirst) {
  show({{0, 0}, {25, 0}});
  poses_[0].has_head = false;
  const auto found = registered();
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Errc::InvalidInput);
}

}  // namespace
}  // namespace relievo::pipeline
