// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A solid for printing, judged by CGAL.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "pipeline/algorithms.h"
#include "pipeline/mesh/completion/solid_head.h"
#include "pipeline/mesh/landmarks/head_frame.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/landmarks/field_head.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"
#include "tests/support/names_of.h"

namespace relievo::pipeline {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Completion usual_head() { return relievo::test::made(&Algorithms::completion, "completion", "generic-head"); }

FaceModel face_of(std::uint32_t seed, double yaw_deg, StageRoom& room) {
  hal::sim::HeadPose pose;
  pose.yaw_deg = yaw_deg;
  const PointCloud cloud = FieldHead(seed).cloud(pose, room.pool);
  GridMesher coarse;
  coarse.max_triangles = 60'000;
  FaceModel model(std::pmr::get_default_resource());
  const auto mesh = room.run([&](StageContext& c) { return GridMesher(coarse).mesh(cloud, c); });
  EXPECT_TRUE(mesh);
  model.mesh = *mesh;  // out of the room's arena
  const auto frame = room.run([&](StageContext& c) { return find_head_frame(model.mesh, c); });
  EXPECT_TRUE(frame);
  model.head_from_camera = frame->head_from_camera;
  return model;
}

TEST(SolidHead, IsClosedManifoldTurnedOutwardsAndStandsOnAFlatNeck) {
  for (const double yaw_deg : {0.0, 25.0}) {
    StageRoom room;
    const FaceModel model = face_of(3, yaw_deg, room);
    const auto solid = room.run([&](StageContext& c) { return make_solid(model, usual_head(), c); });
    ASSERT_TRUE(solid) << solid.error().what.view();
    std::vector<Kernel::Point_3> points;
    for (const Vec3f& v : solid->vertices_mm) points.emplace_back(v.x, v.y, v.z);
    std::vector<std::array<std::size_t, 3>> triangles;
    for (const auto& t : solid->triangles) triangles.push_back({t[0], t[1], t[2]});
    ASSERT_TRUE(pmp::is_polygon_soup_a_polygon_mesh(triangles));
    Mesh mesh;
    pmp::polygon_soup_to_polygon_mesh(points, triangles, mesh);
    EXPECT_TRUE(CGAL::is_closed(mesh));
    EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
    EXPECT_TRUE(pmp::is_outward_oriented(mesh));

    // The neck's foot: one flat piece, as large as a neck.
    double lowest = 0, foot_mm2 = 0;
    std::vector<Vec3d> at;
    for (const Vec3f& v : solid->vertices_mm) {
      at.push_back(apply(model.head_from_camera,
                         {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}));
      lowest = std::min(lowest, at.back().y);
    }
    for (const auto& t : solid->triangles) {
      const Vec3d &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
      if (std::max({a.y, b.y, c.y}) > lowest + 0.01) continue;
      foot_mm2 += std::abs((b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x)) / 2;
    }
    EXPECT_LT(lowest, -100);
    EXPECT_GT(foot_mm2, 3000);
    EXPECT_LT(foot_mm2, 25000);

    // What was measured is there, bit for bit.
    std::set<std::array<float, 3>> there;
    for (std::size_t v = 0; v < solid->vertices_mm.size(); ++v)
      if (solid->measured[v] != 0)
        there.insert({solid->vertices_mm[v].x, solid->vertices_mm[v].y, solid->vertices_mm[v].z});
    std::size_t measured = 0, lost = 0;
    for (std::size_t v = 0; v < model.mesh.vertices_mm.size(); ++v) {
      const Vec3f& p = model.mesh.vertices_mm[v];
      if (model.mesh.measured[v] == 0) continue;
      ++measured;
      lost += 1 - there.count({p.x, p.y, p.z});
    }
    EXPECT_GT(measured, 10'000U);
    EXPECT_LT(lost, measured / 1000);
  }
}

TEST(SolidHead, WhereNoHeadIsFoundNothingIsMadeUp) {
  StageRoom room;
  FaceModel model(std::pmr::get_default_resource());
  const PointCloud sheet = formula_cloud(2, 400, [](double, double) { return 520.0; });
  const auto mesh = room.run([&](StageContext& c) { return GridMesher({}).mesh(sheet, c); });
  ASSERT_TRUE(mesh);
  model.mesh = *mesh;
  const auto solid = room.run([&](StageContext& c) { return make_solid(model, usual_head(), c); });
  ASSERT_FALSE(solid);
  EXPECT_EQ(solid.error().code, Errc::PoorGeometry);
}

}  // namespace
}  // namespace relievo::pipeline
