// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed face against the simulated head's own surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/mesh/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"

namespace relievo::pipeline {
namespace {

using test::StageRoom;

hal::sim::HeadPose turned(double yaw_deg, double pitch_deg) {
  hal::sim::HeadPose pose;
  pose.yaw_deg = yaw_deg;
  pose.pitch_deg = pitch_deg;
  return pose;
}

FaceMesh closed_face(const test::FieldHead& head, const hal::sim::HeadPose& pose, StageRoom& room) {
  const PointCloud cloud = head.cloud_of_two(pose, room.pool);
  auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(cloud, c); });
  EXPECT_TRUE(mesh);
  return std::move(*mesh);
}

double off_the_head(const test::FieldHead& head, const hal::sim::HeadPose& pose, const Vec3f& v) {
  const hal::sim::Vec3 p{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  return std::abs(head.field().distance(pose.world_from_head().transposed() * (p - pose.origin_mm())));
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

TEST(FaceCloser, LeavesNoHoleAndMovesNothingThatWasMeasured) {
  for (const auto& [seed, yaw] : {std::pair{1U, 0.0}, {2U, 12.0}, {3U, -12.0}}) {
    const test::FieldHead head(seed);
    const hal::sim::HeadPose pose = turned(yaw, 0);
    StageRoom room;
    const FaceMesh mesh = closed_face(head, pose, room);
    test::expect_one_manifold_surface(mesh);
    EXPECT_EQ(test::boundary_loops(mesh), 1U) << seed;
    std::vector<double> measured, completed;
    for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
      (mesh.measured[v] != 0 ? measured : completed).push_back(off_the_head(head, pose, mesh.vertices_mm[v]));
    EXPECT_GT(completed.size(), 300U) << "beside the nose, at least";
    EXPECT_LT(percentile(measured, 0.95), 0.35) << seed;
    EXPECT_LT(percentile(completed, 0.5), 1.0) << seed;
    EXPECT_LT(percentile(completed, 0.95), 4.0) << seed;
  }
}

}  // namespace
}  // namespace relievo::pipeline
