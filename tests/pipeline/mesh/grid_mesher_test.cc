// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "pipeline/mesh/detail/sliver_mender.h"
#include "pipeline/mesh/meshers/grid_mesher.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

// A sphere with a round hole of so many pixels; the lattice is 2 px, about 1 mm.
PointCloud pierced_sphere(double radius_px, double noise_mm = 0) {
  return formula_cloud(
      2, 400,
      [&](double sx, double sy) {
        const double dx = 1000 * sx - 30;
        const double dy = 1000 * sy + 20;
        if (dx * dx + dy * dy < radius_px * radius_px) return std::numeric_limits<double>::quiet_NaN();
        return sphere_depth(sx, sy, 600, 90);
      },
      noise_mm);
}

TEST(GridMesher, ClosesASmallHoleWithTheCurvatureOfItsRim) {
  StageRoom room;
  const auto result = mesh_grid(pierced_sphere(4), room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_EQ(boundary_loops(*result), 1U);
  std::size_t filled = 0;
  for (std::size_t v = 0; v < result->vertices_mm.size(); ++v) {
    if (result->measured[v]) continue;
    ++filled;
    EXPECT_NEAR(length(minus(result->vertices_mm[v], Vec3f{0, 0, 600})), 90, 0.03);
    EXPECT_GT(result->sigma_mm[v], 0.02F) << "a guess is less certain than a measurement";
  }
  EXPECT_GT(filled, 5U);
}

TEST(GridMesher, LeavesALargeHoleOpen) {
  StageRoom room;
  const auto result = mesh_grid(pierced_sphere(20), room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  EXPECT_EQ(boundary_loops(*result), 2U);
  EXPECT_EQ(std::count(result->measured.begin(), result->measured.end(), 0), 0);
}

TEST(GridMesher, LeavesEveryHoleOpenWhenAsked) {
  StageRoom room;
  GridMesher options;
  options.max_hole_mm = 0;
  const auto result = mesh_grid(pierced_sphere(4), room, options);
  ASSERT_TRUE(result);
  EXPECT_EQ(boundary_loops(*result), 2U);
}

TEST(GridMesher, AnIslandIsDropped) {
  StageRoom room;
  const PointCloud cloud = formula_cloud(2, 400, [](double sx, double sy) {
    if (sx > 0.15 && sy > 0.15) return 500.0;
    return sx < 0.1 && sy < 0.1 ? 500.0 : std::numeric_limits<double>::quiet_NaN();
  });
  const auto result = mesh_grid(cloud, room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  for (const Vec3f& v : result->vertices_mm) EXPECT_LT(v.x, 55);
}

TEST(GridMesher, ASmallStepIsKnownByLeavingTheSlopeAndASteepFlankIsNot) {
  // Both cover the same 8 mm of depth; the flank over 8 columns, the step between two.
  const auto depth = [](double sx, double over) {
    const double t = std::clamp(sx / over, 0.0, 1.0);
    return 500 + 8 * t;
  };
  StageRoom room;
  const auto flank =
      mesh_grid(formula_cloud(2, 300, [&](double sx, double) { return depth(sx, 0.016); }), room);
  ASSERT_TRUE(flank);
  const auto near_and_far = [](const FaceMesh& m) {
    bool near = false;
    bool far = false;
    for (const Vec3f& v : m.vertices_mm) {
      near |= v.z < 501;
      far |= v.z > 507;
    }
    return near && far;
  };
  EXPECT_TRUE(near_and_far(*flank));
  StageRoom other;
  const auto step =
      mesh_grid(formula_cloud(2, 300, [&](double sx, double) { return depth(sx, 0.0019); }), other);
  ASSERT_TRUE(step);
  EXPECT_FALSE(near_and_far(*step));
}

TEST(GridMesher, TrimsTeethOffTheBoundary) {
  StageRoom room;
  // Every other row is 12 px longer: a comb.
  const PointCloud cloud = formula_cloud(2, 300, [](double sx, double sy) {
    const bool tooth = static_cast<int>(std::lround(1000 * sy) / 2) % 2 == 0;
    return sx < (tooth ? 0.1 : 0.088) ? 500.0 : std::numeric_limits<double>::quiet_NaN();
  });
  const auto result = mesh_grid(cloud, room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  for (const Vec3f& v : result->vertices_mm) EXPECT_LT(v.x, 46);
}

TEST(GridMesher, CutsOffWhiskersAndKeepsCorners) {
  // A square with a strip of surface 3 mm wide growing out of it, as occlusion leaves them.
  const auto cloud = formula_cloud(2, 300, [](double sx, double sy) {
    const bool strip = sx >= 0.05 && sy > 0.02 && sy < 0.026;
    return sx < 0.05 || strip ? 500.0 : std::numeric_limits<double>::quiet_NaN();
  });
  StageRoom room;
  const auto result = mesh_grid(cloud, room);
  ASSERT_TRUE(result);
  expect_clean(*result);
  float right = 0;
  float top = 0;
  for (const Vec3f& v : result->vertices_mm) {
    right = std::max(right, v.x);
    top = std::min(top, v.x + v.y);
  }
  EXPECT_LT(right, 26);
  EXPECT_LT(top, -136) << "the corner at (-75, -75) is rounded by no more than a few millimetres";
  GridMesher options;
  options.finest_cells = 1;
  options.min_width_mm = 0;
  options.max_rim_deg = 90;
  options.outline_wave_mm = 0;
  options.outline_smoothing_mm = 0;
  options.rim_smoothing_mm = 0;
  StageRoom other;
  const auto whole = mesh_grid(cloud, other, options);
  ASSERT_TRUE(whole);
  EXPECT_GT(std::max_element(whole->vertices_mm.begin(), whole->vertices_mm.end(),
                             [](const Vec3f& a, const Vec3f& b) { return a.x < b.x; })
                ->x,
            70);
}

TEST(GridMesher, ScatteredPointsAreNotItsBusiness) {
  StageRoom room;
  PointCloud cloud = formula_cloud(2, 300, [](double, double) { return 500.0; });
  cloud.lattice_step_px = 0;
  const auto result = mesh_grid(cloud, room);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Errc::Unsupported);
}

// A lattice with ragged rims, cracks and noise, as many nodes as it may have.
PointCloud torn_sheet(int size_px) {
  return formula_cloud(
      1, size_px,
      [](double sx, double sy) {
        const double ragged = 0.003 * std::sin(9000 * sy) * std::sin(700 * sx);
        const bool crack = std::abs(std::sin(60 * sx + 9 * sy)) < 0.02;
        return crack || std::hypot(sx, sy) > 0.29 + ragged ? std::numeric_limits<double>::quiet_NaN()
                                                           : 500 + 20 * std::cos(20 * sx);
      },
      0.1);
}

TEST(GridMesher, TheCapHoldsWhateverTheLattice) {
  for (const int most : {1000, 3333, 60'000, 320'000}) {
    StageRoom room;
    GridMesher options;
    options.max_triangles = most;
    options.min_area_mm2 = 0;
    const auto result = mesh_grid(torn_sheet(600), room, options);
    ASSERT_TRUE(result);
    EXPECT_LE(result->triangles.size(), static_cast<std::size_t>(most));
    EXPECT_GT(result->triangles.size(), static_cast<std::size_t>(0.5 * most))
        << "thinned no more than need be";
    expect_one_manifold_surface(*result);
  }
}

TEST(GridMesher, ThinningKeepsWhatFits) {
  // 2 % too many nodes cost 2 % of them, not every second column.
  StageRoom room;
  GridMesher options;
  const PointCloud cloud = formula_cloud(2, 300, [](double, double) { return 500.0; });
  options.max_triangles = static_cast<int>(1.94 * static_cast<double>(cloud.points.size()));
  const auto result = mesh_grid(cloud, room, options);
  ASSERT_TRUE(result);
  EXPECT_GT(static_cast<double>(result->triangles.size()), 0.93 * options.max_triangles);
}

TEST(GridMesher, NoSlivers) {
  for (const double noise_mm : {0.0, 0.1, 0.3}) {
    StageRoom room;
    const auto ball =
        mesh_grid(formula_cloud(
                      2, 400, [](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); }, noise_mm),
                  room);
    ASSERT_TRUE(ball);
    EXPECT_GE(smallest_angle_deg(*ball), kSmallestAngleDeg - 0.01F);
    StageRoom other;
    const auto torn = mesh_grid(torn_sheet(400), other);
    ASSERT_TRUE(torn);
    EXPECT_GE(smallest_angle_deg(*torn), kSmallestAngleDeg - 0.01F);
  }
  for (const char* name : {"d1", "d2", "d3"}) {
    const auto dir = rendered_head(name);
    if (!dir) GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the rendered heads";
    StageRoom room;
    TruthOptions options;
    options.noise_mm = 0.04;
    const auto head = mesh_grid(truth_cloud(*dir, options), room);
    ASSERT_TRUE(head);
    EXPECT_GE(smallest_angle_deg(*head), kSmallestAngleDeg - 0.01F);
  }
}

TEST(GridMesher, OptionsHaveLimits) {
  EXPECT_TRUE(check_options(GridMesher{}, "grid"));
  GridMesher options;
  options.max_incidence_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(check_options(options, "grid"));
  options = {};
  options.max_triangles = 0;
  EXPECT_FALSE(check_options(options, "grid"));
}

// Slow and obvious: each vertex against the truth it was made from; only the cut along the outline makes new
// ones.
TEST(GridMesher, RenderedHeadStaysOnItsSurface) {
  const auto dir = rendered_head("d1");
  if (!dir) GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the rendered heads";
  StageRoom room;
  const PointCloud truth = truth_cloud(*dir, {});
  GridMesher options;
  options.finest_cells = 1;
  options.max_hole_mm = 0;
  options.outline_wave_mm = 0;
  options.outline_smoothing_mm = 0;
  options.rim_smoothing_mm = 0;
  const auto result = mesh_grid(truth, room, options);
  ASSERT_TRUE(result);
  expect_clean(*result);
  std::set<std::tuple<float, float, float>> known;
  for (const CloudPoint& p : truth.points) known.insert({p.at_mm.x, p.at_mm.y, p.at_mm.z});
  for (const Vec3f& v : result->vertices_mm) EXPECT_TRUE(known.count({v.x, v.y, v.z}));
}

}  // namespace
}  // namespace relievo::pipeline
