// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of every triangulator: points made on a known rig come back where they were.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/reconstruct/triangulators.h"
#include "tests/support/names_of.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

Triangulator make(const std::string& name) {
  return relievo::test::made(&Algorithms::triangulator, "triangulator", name);
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

class Triangulators : public testing::TestWithParam<std::string> {};

TEST_P(Triangulators, FindPointsWhereTheyWere) {
  const RectifiedPair pair = rig();
  test::StageFixture fixture(1 << 22, 1 << 20, 1);
  MatchSet set(&fixture.output);
  std::vector<Vec3d> truth;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 500; ++k) {
    const Vec3d p{80 * unit(random), 80 * unit(random), 560 + 100 * unit(random)};
    const double u = 1500 * p.x / p.z + 700;
    const double right = 1500 * (p.x - 120) / p.z + 300;
    set.matches.push_back({{static_cast<float>(u), static_cast<float>(1500 * p.y / p.z + 400)},
                           static_cast<float>(u - right),
                           0,
                           0.1F,
                           0});
    truth.push_back(apply(transposed(pair.rectified_from_left), p));
  }
  set.matches[3].rejected_by = 1;  // is left out
  const auto cloud =
      run_stage(fixture.context, [&](StageContext& c) { return make(GetParam())(pair, set, c); });
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
  test::StageFixture fixture(1 << 20, 1 << 20, 1);
  MatchSet set(&fixture.output);
  for (int pass = 0; pass < 2; ++pass) {
    const auto cloud =
        run_stage(fixture.context, [&](StageContext& c) { return make(GetParam())(pair, set, c); });
    ASSERT_FALSE(cloud);
    EXPECT_EQ(cloud.error().code, Errc::TooFewMatches);
    set.matches.assign(50, {{500, 400}, 600, 0, 0.1F, 1});
  }
}

TEST_P(Triangulators, LeaveOutWhatIsOutsideTheVolume) {
  const RectifiedPair pair = rig();
  test::StageFixture fixture(1 << 20, 1 << 20, 1);
  MatchSet set(&fixture.output);
  set.matches.assign(50, {{500, 400}, static_cast<float>(pair.disparity_px(2000)), 0, 0.1F, 0});
  const auto cloud =
      run_stage(fixture.context, [&](StageContext& c) { return make(GetParam())(pair, set, c); });
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, Errc::TooFewMatches);
}

TEST_P(Triangulators, SayWhenMemoryIsUsedUpAndWhenCancelled) {
  const RectifiedPair pair = rig();
  std::vector<Match> many(5000, {{500, 400}, static_cast<float>(pair.disparity_px(560)), 0, 0.1F, 0});
  test::StageFixture fixture(4096, 4096, 1);
  MatchSet set(std::pmr::get_default_resource());
  set.matches.assign(many.begin(), many.end());
  auto cloud = run_stage(fixture.context, [&](StageContext& c) { return make(GetParam())(pair, set, c); });
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, Errc::OutOfMemory);
  fixture.cancelled = true;
  cloud = run_stage(fixture.context, [&](StageContext& c) { return make(GetParam())(pair, set, c); });
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, Errc::Cancelled);
}

TEST_P(Triangulators, GiveTheSameBytesForAnyNumberOfThreads) {
  const RectifiedPair pair = rig();
  std::vector<CloudPoint> first;
  for (const int threads : {1, 2, 3}) {
    test::StageFixture fixture(1 << 22, 1 << 20, threads);
    MatchSet set(&fixture.output);
    for (int k = 0; k < 2000; ++k) {
      const double z = 500 + 0.1 * k;
      set.matches.push_back({{300.0F + 0.2F * static_cast<float>(k), 400},
                             static_cast<float>(pair.disparity_px(z)),
                             0,
                             0.1F,
                             0});
    }
    const auto cloud =
        run_stage(fixture.context, [&](StageContext& c) { return make(GetParam())(pair, set, c); });
    ASSERT_TRUE(cloud);
    if (first.empty()) first.assign(cloud->points.begin(), cloud->points.end());
    ASSERT_EQ(cloud->points.size(), first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      const CloudPoint &is = cloud->points[k], &was = first[k];
      ASSERT_TRUE(is.at_mm.x == was.at_mm.x && is.at_mm.y == was.at_mm.y && is.at_mm.z == was.at_mm.z &&
                  is.sigma_mm == was.sigma_mm)
          << threads << " threads, point " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Triangulators, testing::ValuesIn(relievo::test::names_of("triangulator")),
                         [](const auto& chosen) { return relievo::test::test_name(chosen.param); });

// Two cameras turned towards each other by 20 degrees, lines of sight as x y 1.
struct ToedRig {
  Rotation right_from_left{{std::cos(0.35), 0, std::sin(0.35), 0, 1, 0, -std::sin(0.35), 0, std::cos(0.35)}};
  Vec3d translation{-200, 3, 30};
  EpipolarRelation relation{};

  ToedRig() {
    // (R l) . (t cross r) = 0, column by column.
    const auto cross = [&](const Vec3d& v) {
      return Vec3d{translation.y * v.z - translation.z * v.y, translation.z * v.x - translation.x * v.z,
                   translation.x * v.y - translation.y * v.x};
    };
    for (int j = 0; j < 3; ++j) {
      const Vec3d column = apply(transposed(right_from_left),
                                 cross({j == 0 ? 1.0 : 0.0, j == 1 ? 1.0 : 0.0, j == 2 ? 1.0 : 0.0}));
      relation.m[j] = column.x;
      relation.m[3 + j] = column.y;
      relation.m[6 + j] = column.z;
    }
  }
  double miss(const PlacePair& p) const {
    const double* m = relation.m;
    return p.left.x * (m[0] * p.right.x + m[1] * p.right.y + m[2]) +
           p.left.y * (m[3] * p.right.x + m[4] * p.right.y + m[5]) + m[6] * p.right.x + m[7] * p.right.y +
           m[8];
  }
  PlacePair see(const Vec3d& p) const {
    const Vec3d q = apply(right_from_left, p);
    const Vec3d r{q.x + translation.x, q.y + translation.y, q.z + translation.z};
    return {{p.x / p.z, p.y / p.z}, {r.x / r.z, r.y / r.z}};
  }
};

double moved2(const PlacePair& a, const PlacePair& b) {
  return std::pow(a.left.x - b.left.x, 2) + std::pow(a.left.y - b.left.y, 2) +
         std::pow(a.right.x - b.right.x, 2) + std::pow(a.right.y - b.right.y, 2);
}

// The slow twin: the depth and place whose images are nearest, by descent from the truth in ever smaller
// steps.
double least_moved2(const ToedRig& rig, const PlacePair& seen, Vec3d p) {
  double best = moved2(rig.see(p), seen);
  for (double step = 4; step > 1e-7; step /= 2)
    for (bool better = true; better;) {
      better = false;
      for (const Vec3d& way : {Vec3d{step, 0, 0}, Vec3d{-step, 0, 0}, Vec3d{0, step, 0}, Vec3d{0, -step, 0},
                               Vec3d{step * p.x / p.z, step * p.y / p.z, step},
                               Vec3d{-step * p.x / p.z, -step * p.y / p.z, -step}}) {
        const Vec3d q{p.x + way.x, p.y + way.y, p.z + way.z};
        if (const double here = moved2(rig.see(q), seen); here < best) {
          best = here;
          p = q;
          better = true;
        }
      }
    }
  return best;
}

TEST(OptimalTriangulator, MovesThePlacesNoMoreThanItMust) {
  const ToedRig rig;
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0, 2.0 / 1500);  // two pixels
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const Vec3d truth{90 * unit(random), 90 * unit(random), 560 + 60 * unit(random)};
    PlacePair seen = rig.see(truth);
    EXPECT_NEAR(rig.miss(seen), 0, 1e-9);
    seen.left.x += noise(random);
    seen.left.y += noise(random);
    seen.right.x += noise(random);
    seen.right.y += noise(random);
    const PlacePair moved = correct_optimally(rig.relation, seen);
    EXPECT_NEAR(rig.miss(moved), 0, 1e-6);
    EXPECT_LT(moved2(moved, seen), 1.0001 * least_moved2(rig, seen, truth) + 1e-14);
  }
}

TEST(OptimalTriangulator, UsesTheRowsThatWereMeasured) {
  const RectifiedPair pair = rig();
  test::StageFixture fixture(1 << 20, 1 << 20, 1);
  MatchSet set(&fixture.output);
  set.matches.assign(10, {{700, 400}, static_cast<float>(pair.disparity_px(560)), 0, 0.1F, 0});
  set.epipolar_shift.offset_px = 2;
  set.epipolar_shift.sigma_px = 0.1;
  const auto cloud = run_stage(
      fixture.context, [&](StageContext& c) { return OptimalTriangulator().triangulate(pair, set, c); });
  ASSERT_TRUE(cloud);
  // Half of the two pixels go to each view: 1 / 1500 * 560 mm.
  EXPECT_NEAR(cloud->points[0].at_mm.y, 560.0 / 1500, 0.01);
}

// As when a camera is rolled. The shift is zero where the point stands in the right view.
TEST(OptimalTriangulator, TakesTheShiftOfTheColumnInTheRightView) {
  const RectifiedPair pair = rig();
  test::StageFixture fixture(1 << 20, 1 << 20, 1);
  MatchSet set(&fixture.output);
  const double disparity_px = pair.disparity_px(560);
  set.matches.assign(10, {{700, 400}, static_cast<float>(disparity_px), 0, 0.1F, 0});
  set.epipolar_shift.slope_x = 0.01;
  set.epipolar_shift.middle_x_px = 700 - disparity_px;
  set.epipolar_shift.sigma_px = 0.1;
  const auto cloud = run_stage(
      fixture.context, [&](StageContext& c) { return OptimalTriangulator().triangulate(pair, set, c); });
  ASSERT_TRUE(cloud);
  EXPECT_NEAR(cloud->points[0].at_mm.y, 0, 1e-3);
}

}  // namespace
}  // namespace relievo::pipeline
