// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A head of a formula, seen by rays: what a pose shows and where it stands are known to the last digit.
#include "pipeline/fuse/pose_registration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "pipeline/fuse/head_fuser.h"
#include "pipeline/fuse/skin_bender.h"
#include "pipeline/fuse/skin_patches.h"
#include "pipeline/model/vector3.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/support/allocation_counter.h"

namespace relievo::pipeline::test {
namespace {

constexpr int kColumns = 130, kRows = 150, kStepPx = 2;
constexpr double kFocalPx = 900, kSigmaMm = 0.05;

// The head turned about its upright axis, its middle 640 mm before the camera.
RigidTransform camera_from_head(double yaw_deg) {
  const double a = yaw_deg * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  RigidTransform out;
  out.rotation = product(Rotation{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, Rotation{{c, 0, s, 0, 1, 0, -s, 0, c}});
  const Vec3d middle{0, 20, -95};
  out.translation_mm = minus(Vec3d{0, 0, 640}, apply(out.rotation, middle));
  return out;
}

// Negative inside: an ellipsoid with waves of some millimetres; `moved_mm`: by how much the lower face stands
// out.
double shape(const Vec3d& p, double moved_mm) {
  const Vec3d q{p.x / 75, (p.y - 20) / 110, (p.z + 95) / 95};
  const double waves = 2.5 * std::sin(p.x / 11) * std::cos(p.y / 9) + 2 * std::sin((p.y + p.z) / 13);
  const double jaw =
      p.y < 10 && p.z > -60 ? moved_mm * std::sin((10 - p.y) / 25) * std::sin((p.z + 60) / 30) : 0;
  return (length(q) - 1) * 85 - waves - jaw;
}

// `further_mm`: by how much the camera stands further away than the first one.
Result<PoseSurface> seen(double yaw_deg, double moved_mm, double further_mm, StageContext& context,
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
  RELIEVO_TRY_ASSIGN(PoseSurface pose, make_pose_surface(cloud, pair, context));
  pose.head_from_camera = head;
  pose.has_head = true;
  return pose;
}

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
  std::vector<PoseSurface> poses_;
};

TEST_F(Poses, ShowTheSurfaceWhereItIs) {
  show({{20, 0}});
  const PoseSurface& pose = poses_[0];
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
    return pose ? std::count_if(pose->trust.begin(), pose->trust.end(), [](float t) { return t > 0; }) : 0;
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
    return weight * SkinPatches::say({0, 0, 1, mm, weight}, usual_mm);
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
    const Vec3d at =
        apply(poses_[1].head_from_camera, wide(poses_[1].at_mm[kResidualEvery * (row * kColumns + column)]));
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
  const std::pmr::vector<Vec3f> first = poses_[0].at_mm, before = poses_[1].at_mm;
  ASSERT_TRUE(room_.run([&](StageContext& c) -> Result<void> {
    bend_to_master(poses_, *found, {1.5, 8, 0.05}, c);
    return {};
  }));
  double jaw_before = 0, jaw = 0, count = 0, brow = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (poses_[1].trust[k] < 0.9F) continue;
    const Vec3d was = apply(poses_[1].head_from_camera, wide(before[k]));
    const Vec3d is = apply(poses_[1].head_from_camera, wide(poses_[1].at_mm[k]));
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
  EXPECT_EQ(distance(first[first.size() / 2], poses_[0].at_mm[first.size() / 2]), 0)
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
    for (std::size_t k = 0; k < poses_[1].at_mm.size(); ++k) {
      const Vec3d at = apply(poses_[1].head_from_camera, wide(poses_[1].at_mm[k]));
      if (poses_[1].trust[k] > 0.9F && at.y > -45 && at.y < -25 && at.z > -30 && std::abs(at.x) < 20)
        most = std::max(most, std::abs(shape(at, 0)));
    }
    return most;
  };
  const double before = furthest_mm();
  EXPECT_GT(before, 4);
  ASSERT_TRUE(room_.run([&](StageContext& c) -> Result<void> {
    bend_to_master(poses_, placed, {1.5, 8, 0.05}, c);
    return {};
  }));
  EXPECT_LT(furthest_mm(), 0.6 * before);
}

// How steeply, in degrees, the fused surface stands to the head's own within so many millimetres of a place.
double steepest_deg(const FaceMesh& mesh, const RigidTransform& head_from_camera, const Vec3d& middle,
                    double within_mm) {
  double least = 1;
  for (const auto& t : mesh.triangles) {
    std::array<Vec3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = apply(head_from_camera, wide(mesh.vertices_mm[t[k]]));
    const Vec3d centre = times(plus(plus(p[0], p[1]), p[2]), 1.0 / 3);
    const Vec3d area = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    if (std::hypot(centre.x - middle.x, centre.y - middle.y) > within_mm || length(area) < 0.2) continue;
    const auto slope = [&](const Vec3d& by) {
      return shape(plus(centre, by), 0) - shape(minus(centre, by), 0);
    };
    least = std::min(
        least, dot(unit(area), unit(Vec3d{slope({0.1, 0, 0}), slope({0, 0.1, 0}), slope({0, 0, 0.1})})));
  }
  return std::acos(least) * 180 / std::numbers::pi;
}

// Two poses of one head that lie more than a millimetre apart, and the first one's edge across the face.
class ApartPoses : public Poses {
 protected:
  double fused_steepest_deg(const Vec3d& middle, double within_mm, const Landmarks& landmarks,
                            double apart_mm, double edge_y, float trust) {
    const auto head = fused(landmarks, apart_mm, edge_y, trust, [](const Vec3d&) { return true; });
    return head ? steepest_deg(*head, poses_[0].head_from_camera, middle, within_mm) : 90;
  }
  Result<FaceMesh> fused(const Landmarks& landmarks, double apart_mm, double edge_y, float trust,
                         const std::function<bool(const Vec3d& in_head)>& measured) {
    for (int k = 0; k < 2; ++k) {
      auto pose = room_.run([](StageContext& c) { return seen(0, 0, 0, c, 0.12); });
      EXPECT_TRUE(pose);
      poses_.push_back(*std::move(pose));
    }
    for (std::size_t k = 0; k < poses_[0].trust.size(); ++k)
      poses_[0].trust[k] *=
          apply(poses_[0].head_from_camera, wide(poses_[0].at_mm[k])).y < edge_y ? 0 : trust;
    Registration placed(std::pmr::get_default_resource());
    placed.poses.resize(2);
    placed.poses[1].first_from_pose.translation_mm.z = apart_mm;
    FaceMesh own(std::pmr::get_default_resource());
    own.vertices_mm = poses_[0].at_mm;
    own.normals = poses_[0].normal;
    own.sigma_mm = poses_[0].sigma_mm;
    for (const Vec3f& at : own.vertices_mm)
      own.measured.push_back(measured(apply(poses_[0].head_from_camera, wide(at))) ? 1 : 0);
    HeadFuserOptions options;
    options.most_bend_mm = 0;
    options.still_mm = 1;
    auto head = room_.run(
        [&](StageContext& c) { return HeadFuser(options).fuse(poses_, placed, own, landmarks, c); });
    EXPECT_TRUE(head);
    return head;
  }
  static Landmarks left_eye() {
    const RigidTransform camera = camera_from_head(0);
    const auto on_skin = [&](double x, double y) {
      Vec3d p{x, y, 40};
      while (shape(p, 0) > 0) p.z -= 0.1;
      return Landmark{narrow(apply(camera, p)), 0.5F, true};
    };
    Landmarks landmarks{};
    landmarks[std::size_t(LandmarkName::EndocanthionLeft)] = on_skin(17, 30);
    landmarks[std::size_t(LandmarkName::ExocanthionLeft)] = on_skin(43, 30);
    return landmarks;
  }
};

TEST_F(ApartPoses, HaveNoStepWhereTheOtherBeginsToCountMost) {
  EXPECT_LT(fused_steepest_deg({0, -14, 0}, 12, {}, 0.7, -20, 1), 12);
}

TEST_F(ApartPoses, HaveNoStepAroundAnEye) {
  EXPECT_LT(fused_steepest_deg({33, 30, 0}, 14, left_eye(), 0.55, -200, 0.9F), 10.5);
}

TEST_F(ApartPoses, SayThatLidsWereMeasuredAndTheEyeBetweenThemWasNot) {
  constexpr double kEyeMm = 6, kVoxelMm = 0.8;
  const auto from_eye = [](const Vec3d& at) { return std::hypot(at.x - 30, at.y - 30); };
  const auto head =
      fused(left_eye(), 0.1, -200, 0.9F, [&](const Vec3d& at) { return from_eye(at) > kEyeMm; });
  ASSERT_TRUE(head);
  int lids = 0, eye = 0;
  for (std::size_t v = 0; v < head->vertices_mm.size(); ++v) {
    const double off = from_eye(apply(poses_[0].head_from_camera, wide(head->vertices_mm[v]))) - kEyeMm;
    if (off > kVoxelMm && off < 3) lids += head->measured[v] != 0 ? 1 : -100;
    if (off < -2 * kVoxelMm) eye += head->measured[v] == 0 ? 1 : -100;
  }
  EXPECT_GT(lids, 100);
  EXPECT_GT(eye, 50);
}

TEST_F(Poses, ThatMeetNothingAreNamed) {
  show({{0, 0}, {0, 0}});
  for (Vec3f& at : poses_[1].at_mm) at.z += 25 * std::sin(at.x / 6);  // something else
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
  for (Vec3f& at : poses_[1].at_mm) at.z += 25 * std::sin(at.x / 6);  // something else
  const auto found = registered();
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->poses[0].joined);
  EXPECT_FALSE(found->poses[1].joined);
  EXPECT_TRUE(found->poses[2].joined);
  EXPECT_TRUE(std::ranges::all_of(poses_[1].trust, [](float t) { return t == 0; }));
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
}  // namespace relievo::pipeline::test
