// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_fuser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "hal/base/statistics.h"
#include "tests/pipeline/fuse/formula_head.h"

namespace relievo::pipeline {
namespace {

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
  Result<FaceMesh> fused(
      const Landmarks& landmarks, double apart_mm, double edge_y, float trust,
      const std::function<bool(const Vec3d& in_head)>& measured,
      const std::function<void(FaceMesh& own)>& complete = [](FaceMesh&) {}) {
    for (int k = 0; k < 2; ++k) {
      auto pose = room_.run([](StageContext& c) { return seen(0, 0, 0, c, 0.12); });
      EXPECT_TRUE(pose);
      poses_.push_back(*std::move(pose));
      for (SurfaceHit& node : poses_.back().nodes) node.sigma_mm *= is_lip(node.at_mm) ? kLipShare : 1;
    }
    for (std::size_t k = 0; k < poses_[0].nodes.size(); ++k)
      poses_[0].nodes[k].trust *=
          apply(poses_[0].head_from_camera, wide(poses_[0].nodes[k].at_mm)).y < edge_y ? 0 : trust;
    Registration placed(std::pmr::get_default_resource());
    placed.poses.resize(2);
    placed.poses[1].first_from_pose.translation_mm.z = apart_mm;
    FaceMesh own(std::pmr::get_default_resource());
    for (const SurfaceHit& node : poses_[0].nodes) {
      own.vertices_mm.push_back(node.at_mm);
      own.normals.push_back(node.normal);
      own.sigma_mm.push_back(node.sigma_mm);
    }
    for (const Vec3f& at : own.vertices_mm)
      own.measured.push_back(measured(apply(poses_[0].head_from_camera, wide(at))) ? 1 : 0);
    complete(own);
    HeadFuser fuser;
    // As good as nothing is bent, and that evenly: what is left apart is for the blend.
    fuser.most_bend_mm = 0;
    fuser.still_mm = 1;
    fuser.bend_width_mm = 40;
    auto head = room_.run([&](StageContext& c) -> Result<FaceMesh> {
      RELIEVO_TRY_ASSIGN(FusedSurface fused, fuser.fuse(poses_, placed, own, landmarks, c));
      return std::move(fused.mesh);
    });
    EXPECT_TRUE(head);
    return head;
  }
  static constexpr float kLipShare = 3;  // as unsure as other skin
  bool is_lip(const Vec3f& place) const {
    if (!has_lips_) return false;
    const Vec3d at = apply(inverse(camera_from_head(0)), wide(place));
    return std::abs(at.x) < 25 && std::abs(at.y + 35) < 10;
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
  bool has_lips_ = false;
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

// The line between lips is smoothed alike in all pictures: as many as there are, they were said to be surer.
TEST_F(ApartPoses, TogetherAreSurerOfSkinAndNotOfLips) {
  has_lips_ = true;
  const auto head = fused({}, 0.01, -200, 1, [](const Vec3d&) { return true; });
  ASSERT_TRUE(head);
  std::array<std::vector<float>, 2> sigmas;
  for (std::size_t v = 0; v < head->vertices_mm.size(); ++v) {
    const Vec3d at = apply(poses_[0].head_from_camera, wide(head->vertices_mm[v]));
    if (std::abs(at.x) < 20 && std::abs(at.y + 35) < 6) sigmas[1].push_back(head->sigma_mm[v]);
    if (std::abs(at.x) < 20 && std::abs(at.y - 20) < 20) sigmas[0].push_back(head->sigma_mm[v]);
  }
  constexpr double kOneMm = 0.12;
  EXPECT_LT(median(sigmas[0]), 0.8 * kOneMm) << sigmas[0].size();
  EXPECT_GT(median(sigmas[1]), 0.9 * kLipShare * kOneMm) << sigmas[1].size();
}

// Parts of it were left as plates behind ears and crown.
TEST_F(ApartPoses, TakeNoBackFromTheMastersCompletedHead) {
  constexpr double kStep = 0.011;  // radians: a millimetre
  const Vec3d middle{0, 20, -95};
  const RigidTransform camera = camera_from_head(0);
  const auto complete = [&](FaceMesh& own) {
    for (double polar = 0; polar < std::numbers::pi; polar += kStep)
      for (double around = 0; around < 2 * std::numbers::pi;
           around += kStep / std::max(std::sin(polar), kStep)) {
        const Vec3d out{std::sin(polar) * std::cos(around), std::cos(polar),
                        std::sin(polar) * std::sin(around)};
        double inside = 40, outside = 150;
        while (outside - inside > 0.01) {
          const double between = (inside + outside) / 2;
          (shape(plus(middle, times(out, between)), 0) < 0 ? inside : outside) = between;
        }
        const Vec3d at = apply(camera, plus(middle, times(out, inside)));
        const Vec3d normal = apply(camera.rotation, out);
        if (dot(normal, unit(at)) < -0.2) continue;  // the poses show it
        own.vertices_mm.push_back(narrow(at));
        own.normals.push_back(narrow(normal));
        own.sigma_mm.push_back(1);
        own.measured.push_back(0);
      }
  };
  const auto head = fused(
      {}, 0.1, -200, 1, [](const Vec3d&) { return true; }, complete);
  ASSERT_TRUE(head);
  double furthest = 0;
  for (const Vec3f& v : head->vertices_mm)
    furthest = std::min(furthest, apply(poses_[0].head_from_camera, wide(v)).z);
  EXPECT_GT(furthest, -135) << "its middle is at -95, its back at -190";
}

}  // namespace
}  // namespace relievo::pipeline
