// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipeline/reconstruct/outlier_filters.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

Result<void> filter(PointCloud& cloud, StageRoom& room) {
  return room.run([&](StageContext& c) { return LocalOutlierFilter{}.reject(cloud, c); });
}

PointCloud sphere(double noise_mm = 0.05) {
  return formula_cloud(
      2, 400, [](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); }, noise_mm);
}

double off_sphere_mm(const CloudPoint& p) {
  return std::abs(std::hypot(double(p.at_mm.x), double(p.at_mm.y), double(p.at_mm.z) - 600) - 90);
}

void throw_off(CloudPoint& p, float mm) {
  const float l = std::hypot(p.at_mm.x, p.at_mm.y, p.at_mm.z);
  const float s = 1 + mm / l;
  p.at_mm = {p.at_mm.x * s, p.at_mm.y * s, p.at_mm.z * s};
}

TEST(OutlierFilter, LeavesACleanSurfaceAlone) {
  StageRoom room;
  PointCloud cloud = sphere();
  const std::size_t before = cloud.points.size();
  ASSERT_TRUE(filter(cloud, room));
  EXPECT_GT(cloud.points.size(), before * 95 / 100);
}

TEST(OutlierFilter, TakesFlyingPointsAndSpikes) {
  StageRoom room;
  PointCloud cloud = sphere();
  std::mt19937 random(5);
  for (CloudPoint& p : cloud.points)
    if (random() % 50 == 0) throw_off(p, random() % 2 ? 4.0F : -25.0F);
  const std::size_t before = cloud.points.size();
  ASSERT_TRUE(filter(cloud, room));
  EXPECT_GT(before - cloud.points.size(), 200U);
  for (const CloudPoint& p : cloud.points) {
    // Towards the rim the surface itself is as steep as a spike.
    if (std::hypot(p.left_px.x - 200, p.left_px.y - 200) < 110) {
      EXPECT_LT(off_sphere_mm(p), 1);
    }
  }
}

TEST(OutlierFilter, TakesAnIslandAndKeepsTheLand) {
  StageRoom room;
  PointCloud cloud = sphere();
  for (CloudPoint& p : cloud.points)
    if (std::hypot(p.left_px.x - 200, p.left_px.y - 200) < 14) throw_off(p, -40);
  const std::size_t before = cloud.points.size();
  ASSERT_TRUE(filter(cloud, room));
  EXPECT_GT(before - cloud.points.size(), 50U);
  for (const CloudPoint& p : cloud.points) EXPECT_LT(off_sphere_mm(p), 1);
}

TEST(OutlierFilter, WorksOnScatteredPointsToo) {
  StageRoom room;
  PointCloud cloud = sphere();
  std::mt19937 random(6);
  std::erase_if(cloud.points, [&](const CloudPoint&) { return random() % 4 != 0; });
  cloud.lattice_step_px = 0;
  std::size_t thrown = 0;
  for (CloudPoint& p : cloud.points)
    if (random() % 60 == 0) {
      throw_off(p, -30);
      ++thrown;
    }
  const std::size_t before = cloud.points.size();
  ASSERT_TRUE(filter(cloud, room));
  EXPECT_GT(cloud.points.size(), (before - thrown) * 9 / 10);
  const auto left = std::count_if(cloud.points.begin(), cloud.points.end(),
                                  [](const CloudPoint& p) { return off_sphere_mm(p) > 5; });
  EXPECT_LT(static_cast<std::size_t>(left), thrown / 5) << "two that fly side by side may support each other";
}

// As where a keypoint selector finds much in one place: 700 points on 12 x 12 pixels, and few elsewhere.
TEST(OutlierFilter, KeepsADensePatchOfScatteredPointsOnAPlane) {
  StageRoom room;
  PointCloud cloud(std::pmr::get_default_resource());
  std::mt19937 random(7);
  std::uniform_real_distribution<float> wide(0, 400), narrow(194, 206);
  const auto add = [&](float x, float y) {
    cloud.points.push_back({{(x - 200) * 0.4F, (y - 200) * 0.4F, 600}, {x, y}, 0.05F});
  };
  for (int k = 0; k < 400; ++k) {
    const float x = wide(random);
    add(x, wide(random));
  }
  for (int k = 0; k < 700; ++k) {
    const float x = narrow(random);
    add(x, narrow(random));
  }
  ASSERT_TRUE(filter(cloud, room));
  const auto dense = std::ranges::count_if(cloud.points, [](const CloudPoint& p) {
    return std::max(std::abs(p.left_px.x - 200), std::abs(p.left_px.y - 200)) <= 6;
  });
  EXPECT_GE(dense, 700);
}

TEST(OutlierFilter, PointsThatAreNotNumbersGo) {
  StageRoom room;
  PointCloud cloud = sphere();
  cloud.points[100].at_mm.x = std::numeric_limits<float>::quiet_NaN();
  cloud.points[200].at_mm.z = -5;
  ASSERT_TRUE(filter(cloud, room));
  for (const CloudPoint& p : cloud.points) EXPECT_TRUE(std::isfinite(p.at_mm.x) && p.at_mm.z > 0);
}

TEST(OutlierFilter, KeepsOrderAndRepeats) {
  StageRoom room;
  PointCloud a = sphere(0.1);
  PointCloud b = sphere(0.1);
  ASSERT_TRUE(filter(a, room));
  ASSERT_TRUE(filter(b, room));
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 1; i < a.points.size(); ++i)
    EXPECT_TRUE(a.points[i - 1].left_px.y < a.points[i].left_px.y ||
                (a.points[i - 1].left_px.y == a.points[i].left_px.y &&
                 a.points[i - 1].left_px.x < a.points[i].left_px.x));
}

TEST(OutlierFilter, EmptyCancelledTinyArenaAndOptions) {
  StageRoom room;
  PointCloud empty(std::pmr::get_default_resource());
  empty.lattice_step_px = 2;
  EXPECT_TRUE(filter(empty, room));
  PointCloud cloud = sphere();
  StageRoom measure;
  PointCloud copy = cloud;
  ASSERT_TRUE(filter(copy, measure));
  for (std::size_t step = 0; step < 12; ++step) {
    StageRoom tiny(1024, measure.scratch.high_water() * step / 12);
    copy = cloud;
    const auto result = filter(copy, tiny);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, Errc::OutOfMemory);
    EXPECT_EQ(copy.points.size(), cloud.points.size()) << "an error leaves the cloud as it was";
  }
  room.cancelled = true;
  const auto cancelled = filter(cloud, room);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, Errc::Cancelled);
  LocalOutlierFilter options;
  options.min_support = 2;
  EXPECT_FALSE(check_options(options, "local"));
}

TEST(OutlierFilter, RenderedHead) {
  const auto dir = rendered_head("d1");
  if (!dir) GTEST_SKIP() << "RELIEVO_TEST_DATA does not name the rendered heads";
  StageRoom room;
  TruthOptions options;
  options.noise_mm = 0.08;
  PointCloud clean = truth_cloud(*dir, options);
  const std::size_t before = clean.points.size();
  ASSERT_TRUE(filter(clean, room));
  EXPECT_GT(clean.points.size(), before * 97 / 100) << "a face is no outlier";
}

}  // namespace
}  // namespace relievo::pipeline
