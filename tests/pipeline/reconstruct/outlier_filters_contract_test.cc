// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of every filter of outliers in the table.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipeline/algorithms.h"
#include "tests/pipeline/mesh/truth_cloud.h"
#include "tests/support/names_of.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using relievo::test::StageFixture;

class OutlierFilters : public testing::TestWithParam<std::string> {
 protected:
  OutlierFilter filter() const { return relievo::test::made(&Algorithms::outliers, "outliers", GetParam()); }
  static PointCloud sphere() {
    return formula_cloud(
        2, 300, [](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); }, 0.05);
  }
};

TEST_P(OutlierFilters, TakeFlyingPointsAndLeaveTheSurface) {
  for (const bool on_lattice : {true, false}) {
    PointCloud cloud = sphere();
    if (!on_lattice) cloud.lattice_step_px = 0;
    const std::size_t all = cloud.points.size();
    std::size_t thrown = 0;
    for (std::size_t k = 50; k < all; k += 101, ++thrown) {
      const float away = 1 + (k % 202 < 101 ? 0.05F : -0.05F);  // 25 to 30 mm along the line of sight
      CloudPoint& p = cloud.points[k];
      p.at_mm = {p.at_mm.x * away, p.at_mm.y * away, p.at_mm.z * away};
    }
    cloud.points[7].at_mm.x = std::numeric_limits<float>::quiet_NaN();
    StageFixture fixture(1 << 16, std::size_t{32} << 20, 2);
    const auto done = run_stage(fixture.context, [&](StageContext& c) { return filter()(cloud, c); });
    ASSERT_TRUE(done);
    std::size_t flying = 0;
    for (const CloudPoint& p : cloud.points)
      if (!(std::abs(std::hypot(double(p.at_mm.x), double(p.at_mm.y), double(p.at_mm.z) - 600) - 90) < 3))
        ++flying;
    EXPECT_LT(static_cast<double>(flying), 0.02 * static_cast<double>(thrown)) << on_lattice;
    EXPECT_GT(static_cast<double>(cloud.points.size()), 0.95 * static_cast<double>(all - thrown))
        << on_lattice;
  }
}

TEST_P(OutlierFilters, JudgeAlikeForAnyNumberOfThreads) {
  std::size_t first = 0;
  for (const int threads : {1, 2, 3}) {
    PointCloud cloud = sphere();
    StageFixture fixture(1 << 16, std::size_t{32} << 20, threads);
    ASSERT_TRUE(run_stage(fixture.context, [&](StageContext& c) { return filter()(cloud, c); }));
    if (first == 0) first = cloud.points.size();
    EXPECT_EQ(cloud.points.size(), first);
  }
}

TEST_P(OutlierFilters, BearNothingTooLittleMemoryAndCancellation) {
  PointCloud nothing(std::pmr::get_default_resource());
  StageFixture small(1024, 1024, 1);
  EXPECT_TRUE(run_stage(small.context, [&](StageContext& c) { return filter()(nothing, c); }));
  PointCloud cloud = sphere();
  const std::size_t all = cloud.points.size();
  const auto refused = run_stage(small.context, [&](StageContext& c) { return filter()(cloud, c); });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::OutOfMemory);
  StageFixture fixture(1 << 16, std::size_t{32} << 20, 2);
  fixture.cancelled = true;
  const auto stopped = filter()(cloud, fixture.context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Errc::Cancelled);
  EXPECT_EQ(cloud.points.size(), all);
}

INSTANTIATE_TEST_SUITE_P(All, OutlierFilters, testing::ValuesIn(relievo::test::names_of("outliers")),
                         [](const auto& chosen) { return relievo::test::test_name(chosen.param); });

}  // namespace
}  // namespace relievo::pipeline
