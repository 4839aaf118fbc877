// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of every triangulator: points made on a known rig come back where they were.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "pipeline/reconstruct/inverse_disparity_triangulator.h"
#include "pipeline/reconstruct/linear_triangulator.h"
#include "tests/support/stage_bench.h"

namespace relievo::pipeline {
namespace {

std::unique_ptr<Triangulator> make(const std::string& name) {
  if (name == "linear-least-squares") return std::make_unique<LinearTriangulator>();
  return std::make_unique<InverseDisparityTriangulator>();
}

RectifiedPair rig() {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = 1000;
  pair.height_px = 800;
  pair.focal_px = 1500;
  pair.baseline_mm = 120;
  pair.left_centre_px = {700, 400};
  pair.right_centre_px = {300, 400};
  pair.near_mm = 400;
  pair.far_mm = 750;
  const double a = 0.1;
  pair.rectified_from_left = {{std::cos(a), 0, -std::sin(a), 0, 1, 0, std::sin(a), 0, std::cos(a)}};
  return pair;
}

class Triangulators : public testing::TestWithParam<const char*> {};

TEST_P(Triangulators, FindPointsWhereTheyWere) {
  const RectifiedPair pair = rig();
  test::StageBench bench(1 << 22, 1 << 20, 1);
  MatchSet set(&bench.output);
  std::vector<Vec3d> truth;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 500; ++k) {
    const Vec3d p{80 * unit(random), 80 * unit(random), 560 + 100 * unit(random)};
    const double u = 1500 * p.x / p.z + 700;
    const double right = 1500 * (p.x - 120) / p.z + 300;
    set.matches.push_back({{static_cast<float>(u), static_cast<float>(1500 * p.y / p.z + 400)}, static_cast<float>(u - right), 0, 0.1F, 0});
    truth.push_back(apply(transposed(pair.rectified_from_left), p));
  }
  set.matches[3].rejected_by = 1;  // is left out
  const auto cloud = run_stage(bench.context, [&](StageContext& c) { return make(GetParam())->triangulate(pair, set, c); });
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->points.size(), 499U);
  for (std::size_t k = 0; k < cloud->points.size(); ++k) {
    const Vec3d& t = truth[k < 3 ? k : k + 1];
    EXPECT_NEAR(cloud->points[k].at_mm.x, t.x, 2e-3);
    EXPECT_NEAR(cloud->points[k].at_mm.y, t.y, 2e-3);
    EXPECT_NEAR(cloud->points[k].at_mm.z, t.z, 2e-3);
    // sigma_z = z^2 / (f B) * sigma_d along the axis, a little more along an oblique line of sight
    const double z = pair.depth_mm(set.matches[k < 3 ? k : k + 1].disparity_px);
    EXPECT_NEAR(cloud->points[k].sigma_mm, z * z / (1500 * 120) * 0.1, 0.1 * z * z / (1500 * 120) * 0.1);
  }
}

TEST_P(Triangulators, RefuseNothingAndAllRejected) {
  const RectifiedPair pair = rig();
  test::StageBench bench(1 << 20, 1 << 20, 1);
  MatchSet set(&bench.output);
  for (int pass = 0; pass < 2; ++pass) {
    const auto cloud = run_stage(bench.context, [&](StageContext& c) { return make(GetParam())->triangulate(pair, set, c); });
    ASSERT_FALSE(cloud);
    EXPECT_EQ(cloud.error().code, Errc::TooFewMatches);
    set.matches.assign(50, {{500, 400}, 600, 0, 0.1F, 1});
  }
}

TEST_P(Triangulators, LeaveOutWhatIsOutsideTheVolume) {
  const RectifiedPair pair = rig();
  test::StageBench bench(1 << 20, 1 << 20, 1);
  MatchSet set(&bench.output);
  set.matches.assign(50, {{500, 400}, static_cast<float>(pair.disparity_px(2000)), 0, 0.1F, 0});
  const auto cloud = run_stage(bench.context, [&](StageContext& c) { return make(GetParam())->triangulate(pair, set, c); });
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, Errc::TooFewMatches);
}

TEST_P(Triangulators, SayWhenMemoryIsUsedUpAndWhenCancelled) {
  const RectifiedPair pair = rig();
  std::vector<Match> many(5000, {{500, 400}, static_cast<float>(pair.disparity_px(560)), 0, 0.1F, 0});
  test::StageBench bench(4096, 4096, 1);
  MatchSet set(std::pmr::get_default_resource());
  set.matches.assign(many.begin(), many.end());
  auto cloud = run_stage(bench.context, [&](StageContext& c) { return make(GetParam())->triangulate(pair, set, c); });
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, Errc::OutOfMemory);
  bench.cancelled = true;
  cloud = run_stage(bench.context, [&](StageContext& c) { return make(GetParam())->triangulate(pair, set, c); });
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, Errc::Cancelled);
}

INSTANTIATE_TEST_SUITE_P(All, Triangulators, testing::Values("inverse-disparity", "linear-least-squares"),
                         [](const auto& chosen) { return std::string(chosen.param) == "inverse-disparity" ? "InverseDisparity" : "LinearLeastSquares"; });

}  // namespace
}  // namespace relievo::pipeline
