// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshers that fit a function, and what every mesher of the catalogue makes of a rendered head's own points.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "hal/base/statistics.h"
#include "pipeline/algorithms.h"
#include "pipeline/mesh/meshers/base_sheet.h"
#include "pipeline/mesh/meshers/scattered_meshers.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

DepthSamples hills(double noise_mm) {
  DepthSamples samples(std::pmr::get_default_resource());
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1);
  samples.usual_depth_mm = 500;
  samples.left = samples.top = -30;
  samples.right = samples.bottom = 30;
  for (double v = -30; v <= 30; v += 0.5)
    for (double u = -30; u <= 30; u += 0.5) {
      if (std::hypot(u - 5, v) < 4) continue;  // a gap
      samples.u.push_back(u);
      samples.v.push_back(v);
      samples.depth.push_back(500 + 5 * std::sin(u / 8) * std::cos(v / 6) + noise_mm * noise(random));
      samples.sigma.push_back(std::max(noise_mm, 0.01));
    }
  return samples;
}

TEST(BezierNet, NeighboursShareBorderAndTangent) {
  StageRoom room;
  const BezierNet net(hills(0.1), 2, 0.01, room.context);
  ASSERT_GT(net.columns(), 20);
  for (int r = 0; r + 1 < net.rows(); ++r)
    for (int c = 0; c + 1 < net.columns(); ++c)
      for (std::size_t i = 0; i < 4; ++i) {
        const BezierNet::Patch &here = net.patch(c, r), &right = net.patch(c + 1, r),
                               &below = net.patch(c, r + 1);
        EXPECT_NEAR(here[i][3], right[i][0], 1e-9);
        EXPECT_NEAR(here[3][i], below[0][i], 1e-9);
        EXPECT_NEAR(here[i][3] - here[i][2], right[i][1] - right[i][0], 1e-9) << "C1";
        EXPECT_NEAR(here[3][i] - here[2][i], below[1][i] - below[0][i], 1e-9);
      }
}

TEST(BezierNet, FollowsTheFunctionAndCarriesItOverGaps) {
  StageRoom room;
  const BezierNet net(hills(0.1), 2, 0.01, room.context);
  double sum = 0;
  int count = 0;
  for (double v = -26; v <= 26; v += 0.7)
    for (double u = -26; u <= 26; u += 0.7) {
      const double off = net.depth(u, v) - (500 + 5 * std::sin(u / 8) * std::cos(v / 6));
      EXPECT_LT(std::abs(off), 0.3);
      sum += off * off;
      ++count;
    }
  EXPECT_LT(std::sqrt(sum / count), 0.05) << "of 0.1 mm noise, 16 points a patch leave a third";
}

TEST(BezierNet, IsNotFittedOnceItIsStopped) {
  StageRoom room;
  room.cancelled = true;
  const DepthSamples samples = hills(0.1);
  const BezierNet net(samples, 2, 0.01, room.context);
  EXPECT_EQ(net.depth(8, 0), samples.usual_depth_mm);
}

TEST(NearestVertex, IsTheNearestOfAll) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> at(-40, 40);
  std::vector<Vec3f> points;
  for (int i = 0; i < 400; ++i) points.push_back({at(random), at(random), 300 + at(random)});
  const NearestVertex nearest(points, std::pmr::get_default_resource());
  for (int i = 0; i < 300; ++i) {
    const Vec3f p{1.5F * at(random), at(random), 300 + at(random)};
    float least = 900;
    for (const Vec3f& q : points) least = std::min(least, squared_distance(p, q));
    const auto hit = nearest.find(p, 30);
    if (least < 900) EXPECT_NEAR(squared_distance(points[hit.vertex], p), least, 1e-3F);
    else EXPECT_EQ(hit.vertex, NearestVertex::kNone);
  }
}

// A plane with 256 holes: the border of each stays, so that five triangles a hole are the fewest there can
// be.
TEST(FinishSurface, WhatCannotBeSimplifiedThatFarSaysSo) {
  StageRoom room;
  FaceMesh base(std::pmr::get_default_resource());
  std::pmr::vector<Triangle> triangles;
  constexpr std::uint32_t kSide = 66;
  for (std::uint32_t v = 0; v < kSide * kSide; ++v) {
    base.vertices_mm.push_back({float(v % kSide) - 33, float(v / kSide) - 33, 500});
    base.normals.push_back({0, 0, -1});
    base.sigma_mm.push_back(0.05F);
    base.measured.push_back(1);
    const std::uint32_t x = v % kSide, y = v / kSide;
    if (x + 1 == kSide || y + 1 == kSide || (x % 4 == 2 && y % 4 == 2)) continue;
    triangles.push_back({v, v + kSide, v + 1});
    triangles.push_back({v + 1, v + kSide, v + kSide + 1});
  }
  base.triangles = triangles;
  const auto finish = [&](int most) {
    std::pmr::vector<Triangle> all = triangles;
    return room.run([&](StageContext& c) {
      return finish_surface(base, base.vertices_mm, all, {.max_triangles = most}, c);
    });
  };
  ASSERT_TRUE(finish(20'000));
  const auto refused = finish(1000);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::InvalidInput);
  EXPECT_EQ(refused.error().where(), "max_triangles");
}

// d1's true points with 0.05 mm of noise: how far from the true surface each mesher's vertices lie.
TEST(MesherCatalogue, OnTheTruthCloud) {
  const auto dir = rendered_head("d1");
  if (!dir) GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the rendered heads";
  TruthOptions exact, noisy;
  exact.step_px = 2;
  noisy.step_px = 4;
  noisy.noise_mm = 0.05;
  StageRoom truth_room;
  const PointCloud truth_points = truth_cloud(*dir, exact), cloud = truth_cloud(*dir, noisy);
  std::vector<Vec3f> truth;
  for (const CloudPoint& p : truth_points.points) truth.push_back(p.at_mm);
  const NearestVertex nearest(truth, std::pmr::get_default_resource());
  for (const auto& [name, median_mm] : std::vector<std::pair<std::string, double>>{{"grid", 0.06},
                                                                                   {"delaunay", 0.06},
                                                                                   {"advancing-front", 0.06},
                                                                                   {"marching-cubes", 0.05},
                                                                                   {"bezier", 0.05},
                                                                                   {"rbf", 0.12},
                                                                                   {"poisson", 0.12}}) {
    AlgorithmSet set;
    ASSERT_TRUE(set.set("mesher", name));
    const auto made = make_algorithms(set);
    ASSERT_TRUE(made);
    StageRoom room;
    const auto result = room.run([&](StageContext& c) { return made->mesher(cloud, c); });
    ASSERT_TRUE(result) << name;
    std::vector<double> off;
    for (std::size_t v = 0; v < result->vertices_mm.size(); v += 7) {
      // Along the normal, to the plane through the nearest true point.
      const Vec3f& p = result->vertices_mm[v];
      const auto hit = nearest.find(p, 3);
      if (hit.vertex == NearestVertex::kNone || !result->measured[v]) continue;
      off.push_back(std::abs(static_cast<double>(dot(minus(p, truth[hit.vertex]), result->normals[v]))));
    }
    const double half = median(off);
    std::cout << name << ": median " << half << " mm, " << result->triangles.size() << " triangles\n";
    EXPECT_LT(half, median_mm) << name;
  }
}

}  // namespace
}  // namespace relievo::pipeline
