// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gaps and outlines of surfaces whose truth is a formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// 2 px of 1000 px focal length at 500 mm: 1 mm a cell.
PointCloud cloud_of(double (*depth)(double, double), double noise_mm = 0) {
  return formula_cloud(2, 300, depth, noise_mm);
}

double boundary_mm(const FaceMesh& m, double* turned) {
  std::set<Edge> edges;
  for (const auto& t : m.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  std::map<std::uint32_t, std::uint32_t> next;
  for (const Edge& e : edges)
    if (!edges.count({e.second, e.first})) next[e.first] = e.second;
  double sum = 0;
  *turned = 0;
  for (const auto& [from, to] : next) {
    const Vec3f a = minus(m.vertices_mm[to], m.vertices_mm[from]);
    const Vec3f b = minus(m.vertices_mm[next.at(to)], m.vertices_mm[to]);
    sum += static_cast<double>(length(a));
    *turned += std::atan2(static_cast<double>(length(cross(a, b))), static_cast<double>(dot(a, b)));
  }
  return sum;
}

TEST(GridMesher, ClosesACrackOfAnyLengthWhereBothSidesContinue) {
  StageRoom room;
  // A net of two cracks of 3 mm across a sphere, right through to the outside.
  const auto result = mesh_grid(cloud_of([](double sx, double sy) {
                                  const bool crack =
                                      std::abs(sx - 0.02) < 0.003 || std::abs(sy + 0.01 - sx / 2) < 0.003;
                                  return crack ? kNothing : sphere_depth(sx, sy, 600, 90);
                                }),
                                room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_EQ(boundary_loops(*result), 1U);
  std::size_t filled = 0;
  for (std::size_t v = 0; v < result->vertices_mm.size(); ++v) {
    if (result->measured[v]) continue;
    ++filled;
    EXPECT_NEAR(length(minus(result->vertices_mm[v], Vec3f{0, 0, 600})), 90, 0.15);
  }
  EXPECT_GT(filled, 200U);
}

TEST(GridMesher, LeavesACrackOpenWhereSomethingStandsInFront) {
  StageRoom room;
  // The same crack, and the right side 6 mm further away: an occlusion edge.
  const auto result = mesh_grid(cloud_of([](double sx, double) {
                                  if (std::abs(sx - 0.02) < 0.003) return kNothing;
                                  return sx < 0.02 ? 500.0 : 506.0;
                                }),
                                room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_EQ(std::count(result->measured.begin(), result->measured.end(), 0), 0);
  for (const Vec3f& v : result->vertices_mm) EXPECT_LT(v.z, 500.5F) << "the larger side alone";
}

TEST(GridMesher, ARaggedOutlineIsCutSmooth) {
  // A disc of 60 mm whose rim the rows leave at random, up to 4 mm early, as matchers do.
  const PointCloud cloud = cloud_of([](double sx, double sy) {
    const double row = std::round(1000 * sy / 2);
    const double early = 0.008 * std::abs(std::sin(12.9898 * row) * 43758.5453 -
                                          std::floor(std::sin(12.9898 * row) * 43758.5453));
    return std::hypot(sx, sy) < 0.12 - early ? 500.0 : kNothing;
  });
  StageRoom room, other;
  GridMesher options;
  options.finest_cells = 1;
  const auto smooth = mesh_grid(cloud, room, options);
  options.outline_smoothing_mm = 0;
  options.rim_smoothing_mm = 0;
  const auto rough = mesh_grid(cloud, other, options);
  ASSERT_TRUE(smooth);
  ASSERT_TRUE(rough);
  expect_clean(*smooth);
  double smooth_turned = 0, rough_turned = 0;
  const double smooth_mm = boundary_mm(*smooth, &smooth_turned);
  const double rough_mm = boundary_mm(*rough, &rough_turned);
  EXPECT_LT(smooth_mm, 2 * 3.14159 * 60 * 1.02) << "no longer than the circle's";
  EXPECT_GT(rough_mm, 1.15 * smooth_mm);
  EXPECT_GT(rough_turned, 4 * smooth_turned);
  EXPECT_GT(area_mm2(smooth->vertices_mm, smooth->triangles), 0.93 * 3.14159 * 58 * 58) << "little is lost";
  for (const Vec3f& v : smooth->vertices_mm) EXPECT_NEAR(v.z, 500, 1e-3) << "cut, not moved";
}

TEST(GridMesher, WavesOfTheOutlineAreStraightenedByGiveAndTake) {
  // A ball's cap whose border swings 3 mm in and out, 16 mm from wave to wave.
  const PointCloud cloud = cloud_of([](double sx, double sy) {
    const double edge = 0.1 + 0.006 * std::sin(20 * std::atan2(sy, sx));
    return std::hypot(sx, sy) < edge ? sphere_depth(sx, sy, 600, 90) : kNothing;
  });
  GridMesher wavy;
  wavy.outline_wave_mm = 0;
  StageRoom room, other;
  const auto straight = mesh_grid(cloud, room);
  const auto before = mesh_grid(cloud, other, wavy);
  ASSERT_TRUE(straight && before);
  expect_clean(*straight);
  EXPECT_EQ(boundary_loops(*straight), 1U);
  double turned = 0, turned_before = 0;
  boundary_mm(*straight, &turned);
  boundary_mm(*before, &turned_before);
  EXPECT_LT(turned, 0.5 * turned_before);
  EXPECT_GT(area_mm2(straight->vertices_mm, straight->triangles),
            0.99 * area_mm2(before->vertices_mm, before->triangles))
      << "what it takes it gives";
  std::size_t given = 0;
  for (std::size_t v = 0; v < straight->vertices_mm.size(); ++v) {
    if (straight->measured[v]) continue;
    ++given;
    EXPECT_NEAR(length(minus(straight->vertices_mm[v], Vec3f{0, 0, 600})), 90, 0.25)
        << "it goes on as the ball does";
    const float cosine = -dot(straight->normals[v], unit(straight->vertices_mm[v]));
    EXPECT_GT(straight->sigma_mm[v], 0.0199F * cosine) << "no more certain than what was measured";
  }
  EXPECT_GT(given, 100U);
}

TEST(GridMesher, TheRimThatTurnsAwayGoesAndAHoleInsideKeepsItsSurroundings) {
  // A sphere seen up to its horizon; a hole of 24 mm on its steep side.
  const PointCloud cloud = cloud_of([](double sx, double sy) {
    const double depth = sphere_depth(sx, sy, 600, 60);
    if (std::hypot(sx * depth - 38, sy * depth) < 9) return kNothing;
    return depth;
  });
  StageRoom room;
  const auto result = mesh_grid(cloud, room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_EQ(boundary_loops(*result), 2U);
  double steepest = 0;
  for (std::size_t v = 0; v < result->vertices_mm.size(); ++v) {
    const Vec3f n = result->normals[v];
    const double cosine = -static_cast<double>(dot(n, unit(result->vertices_mm[v])));
    steepest = std::max(steepest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / 3.14159265);
  }
  EXPECT_LT(steepest, 74) << "max_rim_deg is 70, a slope a mean over 3 mm";
  EXPECT_GT(steepest, 62);
}

TEST(GridMesher, AHoleAtTheOutlineIsNoNickInIt) {
  // A sheet that is round, with two holes that stay open: one 3 mm from the outside, as between strands of
  // hair, one 20 mm.
  const PointCloud cloud = cloud_of([](double sx, double sy) {
    const double x = sx * 500;
    const double y = sy * 500;
    if (std::hypot(x, y) > 60 || std::hypot(x, y + 54) < 3 || std::hypot(x, y - 37) < 3) return kNothing;
    return 500.0;
  });
  GridMesher options;
  options.max_hole_mm = 0;
  StageRoom room;
  const auto result = mesh_grid(cloud, room, options);
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_EQ(boundary_loops(*result), 2U);
  EXPECT_GT(area_mm2(result->vertices_mm, result->triangles), 0.93 * 3.14159 * 60 * 60) << "little is lost";
  for (const Vec3f& v : result->vertices_mm)
    EXPECT_FALSE(std::abs(v.x) < 5 && v.y < -55) << "the bow passes below the hole: it has no walls";
}

}  // namespace
}  // namespace relievo::pipeline
