// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every mesher keeps, whichever it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "pipeline/algorithms.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"
#include "tests/support/names_of.h"

namespace relievo::pipeline {
namespace {

Mesher make(const std::string& name) { return relievo::test::made(&Algorithms::mesher, "mesher", name); }

// Every mesher in the table: a new one is found.
std::vector<std::string> all_meshers() {
  for (const OptionDescription& option : describe_algorithms())
    if (option.key == "mesher") return option.names;
  return {};
}

// What a mesher makes of a ball without noise, where the surface is no steeper than 60 degrees. Those that
// go through the points or near them, and those that fit a function with fewer freedoms.
struct Expected {
  float off_mm = 0.02F, steep_off_mm = 0.02F;
  float normal = 0.998F;
  float plane_normal = 0.9999F;
  std::size_t borders = 1;        // it may tear where the points are sparsest
  double head_area_mm2 = 25'000;  // of a whole face
};
Expected expected_of(const std::string& name) {
  if (name == "rbf" || name == "bezier") return {0.06F, 0.6F, 0.998F};
  if (name == "marching-cubes") return {0.03F, 0.06F, 0.998F};
  if (name == "poisson") return {0.6F, 1.5F, 0.97F, 0.95F, 5, 20'000};
  return {};
}

PointCloud plane(double noise_mm = 0) {
  return formula_cloud(
      2, 300, [](double sx, double sy) { return 500 / (1 - 0.3 * sx + 0.2 * sy); }, noise_mm);
}

PointCloud sphere(double noise_mm = 0) {
  return formula_cloud(
      2, 400, [](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); }, noise_mm);
}

bool quick(const std::string& name) { return name == "grid" || name == "delaunay"; }

class MesherContract : public testing::TestWithParam<std::string> {
 protected:
  Result<FaceMesh> mesh(const PointCloud& cloud, StageRoom& room) const {
    return room.run([&](StageContext& c) { return make(GetParam())(cloud, c); });
  }
};

TEST_P(MesherContract, NoPointsAreNoFace) {
  StageRoom room;
  PointCloud cloud(std::pmr::get_default_resource());
  cloud.lattice_step_px = 2;
  const auto result = mesh(cloud, room);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Errc::PoorGeometry);
}

TEST_P(MesherContract, AFewPointsAreNoFace) {
  StageRoom room;
  const PointCloud cloud = formula_cloud(2, 20, [](double, double) { return 500.0; });
  const auto result = mesh(cloud, room);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Errc::PoorGeometry);
}

TEST_P(MesherContract, PointsThatAreNotNumbersAreLeftOut) {
  StageRoom room;
  PointCloud cloud = plane();
  for (std::size_t i = 0; i < cloud.points.size(); i += 997) {
    cloud.points[i].at_mm.z =
        i % 2 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
    if (i % 3 == 0) cloud.points[i].left_px.x = std::numeric_limits<float>::quiet_NaN();
  }
  const auto result = mesh(cloud, room);
  ASSERT_TRUE(result);
  expect_clean(*result);
}

TEST_P(MesherContract, PlaneKeepsItsAreaAndNormal) {
  StageRoom room;
  const auto result = mesh(plane(), room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  // z = 500 + 0.3 x - 0.2 y over the pyramid of 300 px: the true area from its corners.
  const auto corner = [](double px, double py) {
    const double sx = px / 1000, sy = py / 1000, z = 500 / (1 - 0.3 * sx + 0.2 * sy);
    return Vec3f{static_cast<float>(sx * z), static_cast<float>(sy * z), static_cast<float>(z)};
  };
  const std::vector<Vec3f> corners{corner(-150, -150), corner(148, -150), corner(148, 148),
                                   corner(-150, 148)};
  const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}};
  const double truth = area_mm2(corners, two);
  const double area = area_mm2(result->vertices_mm, result->triangles);
  EXPECT_LT(area, truth * (quick(GetParam()) ? 1.0001 : 1.01));
  EXPECT_GT(
      area,
      truth * 0.925);  // the outline runs most of a lattice step inside, its corners rounded as no face's are
  const Vec3f normal = unit(Vec3f{0.3F, -0.2F, -1});
  for (const Vec3f& n : result->normals) EXPECT_GT(dot(n, normal), expected_of(GetParam()).plane_normal);
}

TEST_P(MesherContract, SphereKeepsItsShape) {
  StageRoom room;
  const auto result = mesh(sphere(), room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_LE(boundary_loops(*result), expected_of(GetParam()).borders);
  const Expected expected = expected_of(GetParam());
  for (std::size_t v = 0; v < result->vertices_mm.size(); ++v) {
    const Vec3f out = minus(result->vertices_mm[v], Vec3f{0, 0, 600});
    const float cosine = std::abs(dot(unit(result->vertices_mm[v]), unit(out)));
    EXPECT_NEAR(length(out), 90, cosine < 0.5F ? expected.steep_off_mm : expected.off_mm);
    if (cosine < 0.5F) continue;  // the rim, where the lattice is coarse
    EXPECT_GT(dot(unit(out), result->normals[v]), expected.normal);
    EXPECT_NEAR(result->sigma_mm[v], 0.02F * cosine, 0.002F);
  }
  // The cap 40 mm high, well inside the rim: 2 pi r h (Archimedes).
  std::vector<Triangle> cap;
  for (const Triangle& t : result->triangles)
    if (result->vertices_mm[t[0]].z + result->vertices_mm[t[1]].z + result->vertices_mm[t[2]].z <
        3 * (510 + 40))
      cap.push_back(t);
  const double truth = 2 * std::numbers::pi * 90 * 40;
  EXPECT_NEAR(area_mm2(result->vertices_mm, cap), truth, 0.005 * truth);
}

TEST_P(MesherContract, NoiseAndDropoutsStillGiveOneCleanSurface) {
  StageRoom room;
  PointCloud cloud = sphere(0.15);
  std::mt19937 random(3);
  std::erase_if(cloud.points, [&](const CloudPoint&) { return random() % 12 == 0; });
  for (CloudPoint& p : cloud.points)
    if (random() % 40 == 0) {
      const float push = 1 + static_cast<float>(static_cast<int>(random() % 200) - 100) / 1000;
      p.at_mm = times(p.at_mm, push);
    }
  const auto result = mesh(cloud, room);
  ASSERT_TRUE(result);
  expect_clean(*result);
}

TEST_P(MesherContract, AStepIsNotBridged) {
  StageRoom room;
  const PointCloud cloud = formula_cloud(2, 300, [](double sx, double) { return sx < 0.02 ? 500.0 : 540.0; });
  const auto result = mesh(cloud, room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  for (const Vec3f& v : result->vertices_mm)
    EXPECT_NEAR(v.z, 500, 1) << "the larger half is the one that stays";
}

TEST_P(MesherContract, NeverMoreTrianglesThanAllowed) {
  StageRoom room;
  AlgorithmSet set;
  ASSERT_TRUE(set.set("mesher", GetParam()));
  const std::string limit = GetParam() + ".max_triangles";
  ASSERT_TRUE(set.set(limit, "6000"));
  const auto made = make_algorithms(set);
  ASSERT_TRUE(made);
  const PointCloud cloud = sphere(0.05);
  const auto result = room.run([&](StageContext& c) { return made->mesher(cloud, c); });
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_LE(result->triangles.size(), 6000U);
  EXPECT_GT(result->triangles.size(), 500U);
}

TEST_P(MesherContract, SameResultTwice) {
  StageRoom first, second;
  const PointCloud cloud = sphere(0.1);
  const auto a = mesh(cloud, first);
  const auto b = mesh(cloud, second);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->vertices_mm.size(), b->vertices_mm.size());
  EXPECT_TRUE(a->triangles == b->triangles);
  for (std::size_t v = 0; v < a->vertices_mm.size(); ++v) {
    EXPECT_EQ(a->normals[v].x, b->normals[v].x);
    EXPECT_EQ(a->sigma_mm[v], b->sigma_mm[v]);
  }
}

TEST_P(MesherContract, ATinyArenaIsAnErrorNotACrash) {
  const PointCloud cloud = formula_cloud(4, 300, [](double, double) { return 500.0; });
  StageRoom roomy;
  ASSERT_TRUE(mesh(cloud, roomy));
  const std::size_t output = roomy.output.high_water();
  const std::size_t scratch = roomy.scratch.high_water();
  const std::size_t steps = quick(GetParam()) ? 24 : 5;
  for (std::size_t step = 0; step < steps; ++step) {
    StageRoom small_output(output * step / steps, scratch);
    StageRoom small_scratch(output, scratch * step / steps);
    for (StageRoom* room : {&small_output, &small_scratch}) {
      const auto result = mesh(cloud, *room);
      ASSERT_FALSE(result) << step;
      EXPECT_EQ(result.error().code, Errc::OutOfMemory);
    }
  }
}

TEST_P(MesherContract, Cancelled) {
  StageRoom room;
  room.cancelled = true;
  const auto result = mesh(plane(), room);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Errc::Cancelled);
}

TEST_P(MesherContract, RenderedHeads) {
  for (const char* name : {"d1", "d2", "d3"}) {
    if (!quick(GetParam()) && name != std::string("d1")) break;
    const auto dir = rendered_head(name);
    if (!dir) GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the rendered heads";
    StageRoom room;
    TruthOptions options;
    options.noise_mm = 0.08;
    options.outlier_share = 0.01;
    const auto result = mesh(truth_cloud(*dir, options), room);
    ASSERT_TRUE(result);
    expect_clean(*result);
    EXPECT_LE(result->triangles.size(), 470'000U);
    EXPECT_GT(area_mm2(result->vertices_mm, result->triangles), expected_of(GetParam()).head_area_mm2)
        << "a whole face";
  }
}

INSTANTIATE_TEST_SUITE_P(All, MesherContract, testing::ValuesIn(all_meshers()), [](const auto& test_case) {
  std::string name = test_case.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace relievo::pipeline
