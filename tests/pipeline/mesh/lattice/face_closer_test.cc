// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed face against the simulated head's own surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory_resource>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/mesh/lattice/head_chart.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/model/vector3.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/support/proof.h"

namespace relievo::pipeline {
namespace {

hal::sim::HeadPose turned(double yaw_deg, double pitch_deg) {
  hal::sim::HeadPose pose;
  pose.yaw_deg = yaw_deg;
  pose.pitch_deg = pitch_deg;
  return pose;
}

constexpr double kFacing = 8;  // turned so, a head faces the place between the cameras

FaceMesh closed_face(const FieldHead& head, const hal::sim::HeadPose& pose, StageRoom& room) {
  const PointCloud cloud = head.cloud_of_two(pose, room.pool);
  auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  EXPECT_TRUE(mesh);
  return std::move(*mesh);
}

Vec3d in_true_head(const hal::sim::HeadPose& pose, const Vec3f& v) {
  const hal::sim::Vec3 p{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  const hal::sim::Vec3 h = pose.world_from_head().transposed() * (p - pose.origin_mm());
  return {h.x, h.y, h.z};
}

double off_the_head(const FieldHead& head, const hal::sim::HeadPose& pose, const Vec3f& v) {
  const hal::sim::Vec3 p{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  return std::abs(head.field().distance(pose.world_from_head().transposed() * (p - pose.origin_mm())));
}

TEST(FaceCloser, LeavesNoHoleAndLiesNearTheHead) {
  for (const auto& [seed, yaw] : {std::pair{1U, 0.0}, {2U, 12.0}, {3U, -12.0}}) {
    const FieldHead head(seed);
    const hal::sim::HeadPose pose = turned(yaw, 0);
    StageRoom room;
    const FaceMesh mesh = closed_face(head, pose, room);
    expect_one_manifold_surface(mesh);
    EXPECT_EQ(boundary_loops(mesh), 1U) << seed;
    std::vector<double> measured, completed;
    double lowest_measured = 0, lowest = 0;  // of the chin
    for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
      (mesh.measured[v] != 0 ? measured : completed).push_back(off_the_head(head, pose, mesh.vertices_mm[v]));
      const Vec3d at = in_true_head(pose, mesh.vertices_mm[v]);
      if (std::abs(at.x) > 4) continue;
      lowest = std::min(lowest, at.y);
      if (mesh.measured[v] != 0) lowest_measured = std::min(lowest_measured, at.y);
    }
    EXPECT_GT(lowest, lowest_measured - 4.5) << "no throat that nobody saw hangs from a chin";
    EXPECT_GT(completed.size(), 300U) << "beside the nose, at least";
    EXPECT_LT(percentile(measured, 0.95), 0.35) << seed;
    EXPECT_LT(percentile(completed, 0.5), 0.5) << seed;
    EXPECT_LT(percentile(completed, 0.8), 2.2)
        << seed << ", the rest is under the chin and beyond what either side shows";
    EXPECT_LT(percentile(completed, 0.95), 5) << seed;
    std::printf("completed: median %.2f, 95 %% %.2f mm\n", percentile(completed, 0.5),
                percentile(completed, 0.95));
  }
}

// The last rows before the hidden side of a nose are what a matcher's window mixes with what lies behind.
// Where the completed side meets them no edge is seen.
TEST(FaceCloser, MeetsWhatWasMeasuredWithoutAnEdge) {
  constexpr double kMixedMm = 3, kLean = 0.5;
  const FieldHead head(1);
  const hal::sim::HeadPose pose = turned(25, 0);
  const hal::sim::Vec3 tip = head.field().nose.tip();
  const auto beside_nose = [&](const Vec3f& v) {
    const Vec3d at = in_true_head(pose, v);
    return std::abs(at.x - tip.x) < 25 && at.y > tip.y + 3 && at.y < tip.y + 30;
  };
  StageRoom room;
  PointCloud cloud = head.cloud_of_two(pose, room.pool);
  std::map<std::int64_t, std::vector<CloudPoint*>> rows;  // from left to right
  for (CloudPoint& p : cloud.points) rows[std::lround(p.at_mm.y / p.at_mm.z * 2000)].push_back(&p);
  for (auto& [row, points] : rows) {
    std::ranges::sort(points, {}, [](const CloudPoint* p) { return p->at_mm.x / p->at_mm.z; });
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const Vec3f rim = points[k]->at_mm, behind = points[k + 1]->at_mm;
      if (!beside_nose(rim) || distance(rim, behind) < 4) continue;
      for (std::size_t i = 0; i <= k; ++i) {
        const double mm = kMixedMm - double(distance(points[i]->at_mm, rim));
        if (mm > 0) points[i]->at_mm = times(points[i]->at_mm, float(1 - kLean * mm / double(rim.z)));
      }
    }
  }
  const auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  ASSERT_TRUE(mesh);
  std::vector<double> turns;  // of the normal, degrees within a millimetre of the seam
  for (const auto& t : mesh->triangles) {
    const Vec3f& at = mesh->vertices_mm[t[0]];
    if (mesh->measured[t[0]] == mesh->measured[t[1]] || !beside_nose(at)) continue;
    float least = 1;
    for (std::size_t v = 0; v < mesh->vertices_mm.size(); ++v)
      if (distance(mesh->vertices_mm[v], at) < 1)
        least = std::min(least, dot(mesh->normals[v], mesh->normals[t[0]]));
    turns.push_back(std::acos(double(least)) * 180 / std::numbers::pi);
  }
  ASSERT_GT(turns.size(), 50U);
  EXPECT_LT(percentile(turns, 0.5), 8);
}

// In dark nostrils a matcher leads flaps from rim to rim, on one side of a jaw a pin to what lies behind, and
// says that it is unsure: they are laid anew.
TEST(FaceCloser, LaysAnewWhatIsUnsureInTheLowerFace) {
  struct Box {
    double left, right, bottom, top;
  };
  for (const Box& box : {Box{-9, 9, -17, -8}, Box{20, 26, -52, -46}}) {
    const FieldHead head(1);
    const hal::sim::HeadPose pose = turned(kFacing, 0);
    StageRoom room;
    PointCloud cloud = head.cloud_of_two(pose, room.pool);
    const auto within = [&](const Vec3f& v) {
      const hal::sim::Vec3 at{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
      const hal::sim::Vec3 p =
          pose.world_from_head().transposed() * (at - pose.origin_mm()) - head.field().nose.tip();
      return p.x > box.left && p.x < box.right && p.y > box.bottom && p.y < box.top;
    };
    for (CloudPoint& p : cloud.points) {
      if (!within(p.at_mm)) continue;
      for (float Vec3f::*const axis : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) p.at_mm.*axis *= 0.994F;
      p.sigma_mm *= 10;
    }
    auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
    ASSERT_TRUE(mesh);
    std::vector<double> off;
    for (const Vec3f& v : mesh->vertices_mm)
      if (within(v)) off.push_back(off_the_head(head, pose, v));
    ASSERT_GT(off.size(), 50U);
    EXPECT_LT(percentile(off, 0.5), 0.7) << box.left;
  }
}

// Chins of open mouths lie far from the nose.
TEST(FaceOutline, HoldsALongChin) {
  FaceOutline outline{HeadChart(RigidTransform{})};
  const Vec3f chin = narrow(minus(Vec3d{0, -98, -12}, HeadChart::kCentreMm));
  outline.below_mm = 105;
  EXPECT_GT(outline.depth_mm(chin), 3);
  outline.below_mm = 95;
  EXPECT_LT(outline.depth_mm(chin), 0);
}

// A heap that is used up ends no visit, and what was known of a face is wiped with the arenas.
TEST(FaceCloser, TakesNothingButTheStagesMemory) {
  const FieldHead head(1);
  StageRoom room;
  const PointCloud cloud = head.cloud_of_two(turned(kFacing, 0), room.pool);
  std::pmr::memory_resource* const before = std::pmr::set_default_resource(std::pmr::null_memory_resource());
  const auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  std::pmr::set_default_resource(before);
  EXPECT_TRUE(mesh);
}

// The border, in the true head's frame.
std::vector<Vec3d> outline(const FaceMesh& mesh, const hal::sim::HeadPose& pose) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles_of;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++triangles_of[std::minmax(t[i], t[(i + 1) % 3])];
  std::vector<Vec3d> border;
  for (const auto& [edge, count] : triangles_of) {
    if (count != 1) continue;
    border.push_back(in_true_head(pose, mesh.vertices_mm[edge.first]));
  }
  return border;
}

double rms_between(const std::vector<Vec3d>& from, const std::vector<Vec3d>& to) {
  double sum = 0;
  for (const Vec3d& p : from) {
    double least = 1e9;
    for (const Vec3d& q : to)
      least =
          std::min(least, (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
    sum += least;
  }
  return std::sqrt(sum / static_cast<double>(from.size()));
}

TEST(FaceCloser, CutsTheSameOutlineHoweverTheHeadIsTurned) {
  constexpr std::array kSeeds{1U, 2U, 3U};
  for (const std::uint32_t seed : std::span(kSeeds).first(relievo::test::trials(3))) {
    const FieldHead head(seed);
    const auto cut_at = [&](double yaw, double pitch) {
      const hal::sim::HeadPose pose = turned(yaw, pitch);
      StageRoom room;
      return outline(closed_face(head, pose, room), pose);
    };
    const std::vector<Vec3d> facing = cut_at(kFacing, 0);
    for (const auto& [yaw, pitch] :
         {std::pair{0.0, 0.0}, {2.0, 3.0}, {15.0, 0.0}, {14.0, -3.0}, {8.0, 6.0}}) {
      const std::vector<Vec3d> other = cut_at(yaw, pitch);
      EXPECT_LT(rms_between(other, facing), 2.5)
          << "seed " << seed << ", turned by " << yaw << ", bowed by " << pitch;
      EXPECT_LT(rms_between(facing, other), 2.5)
          << "seed " << seed << ", turned by " << yaw << ", bowed by " << pitch;
    }
  }
}

}  // namespace
}  // namespace relievo::pipeline
