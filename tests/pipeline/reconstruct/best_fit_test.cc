// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/best_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/sim/base/noise.h"

namespace relievo::pipeline::best_fit {
namespace {

constexpr Vec3d kCentre{-31, 12, 571};
constexpr double kRadius = 30;

// The cap that a camera at the origin sees, moved radially by `noise_mm` deviations.
std::vector<Vec3d> cap(int count, double noise_mm) {
  hal::sim::Random random(9);
  std::vector<Vec3d> points;
  while (static_cast<int>(points.size()) < count) {
    const Vec3d d{random.normal(), random.normal(), random.normal()};
    const Vec3d out = times(d, 1 / length(d));
    if (out.z > -0.5) continue;
    points.push_back(plus(kCentre, times(out, kRadius + noise_mm * random.normal())));
  }
  return points;
}

std::vector<Vec3d> plate(int count, double noise_mm) {
  hal::sim::Random random(4);
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-90, 90), y = random.uniform(-60, 60);
    points.push_back({x, y, 560 + 0.3 * x - 0.2 * y + noise_mm * random.normal()});
  }
  return points;
}

TEST(FitSphere, FindsAnExactOne) {
  const auto s = fit_sphere(cap(200, 0));
  ASSERT_TRUE(s);
  EXPECT_LT(distance(s->centre_mm, kCentre), 1e-9);
  EXPECT_NEAR(s->radius_mm, kRadius, 1e-9);
}

TEST(FitSphere, NoiseBiasesNeitherCentreNorRadius) {
  const auto s = fit_sphere(cap(40000, 0.3));
  ASSERT_TRUE(s);
  EXPECT_LT(distance(s->centre_mm, kCentre), 0.02);
  EXPECT_NEAR(s->radius_mm, kRadius, 0.02);
}

TEST(FitPlane, FindsAnExactOneTowardsTheCamera) {
  const auto s = fit_plane(plate(100, 0));
  ASSERT_TRUE(s);
  const double l = std::sqrt(0.09 + 0.04 + 1);
  EXPECT_LT(distance(s->normal, {0.3 / l, -0.2 / l, -1 / l}), 1e-6);
  for (const Vec3d& p : plate(100, 0)) EXPECT_NEAR(deviation(*s, p), 0, 1e-6);
}

TEST(ReadForm, TheRangeIsThatOfThePointsThatWereKept) {
  std::vector<Vec3d> points = plate(1000, 0);
  for (std::size_t k : {3U, 77U, 500U}) points[k].z += 9;  // 3 in 1000
  const auto all = read_plane(points, 0), most = read_plane(points, 0.003);
  ASSERT_TRUE(all && most);
  EXPECT_GT(all->range_mm, 7);
  EXPECT_EQ(all->discarded, 0U);
  EXPECT_LT(most->range_mm, 1e-6);
  EXPECT_EQ(most->discarded, 3U);
  EXPECT_EQ(most->used, 997U);
}

TEST(ReadForm, FourOutliersAreOneMoreThanMayGo) {
  std::vector<Vec3d> points = cap(1000, 0);
  for (std::size_t k : {3U, 77U, 500U, 900U})
    points[k] = plus(kCentre, times(minus(points[k], kCentre), 1.1));
  const auto most = read_sphere(points, 0.003);
  ASSERT_TRUE(most);
  EXPECT_NEAR(most->range_mm, 0.1 * kRadius, 0.1);
}

TEST(ReadForm, DeviationsAreSignedOutwards) {
  EXPECT_GT(deviation(Sphere{kCentre, kRadius}, plus(kCentre, {0, 0, -31})), 0);
  EXPECT_LT(deviation(Sphere{kCentre, kRadius}, plus(kCentre, {0, 0, -29})), 0);
}

TEST(ReadForm, PointsThatDetermineNothingAreAnError) {
  EXPECT_EQ(fit_sphere(cap(19, 0)).error().code, Errc::PoorGeometry);
  EXPECT_EQ(fit_plane({}).error().code, Errc::PoorGeometry);
  std::vector<Vec3d> line, point(100, Vec3d{1, 2, 3});
  for (int i = 0; i < 100; ++i) line.push_back({1.0 * i, 2.0 * i, 500.0 - i});
  EXPECT_EQ(fit_plane(line).error().code, Errc::PoorGeometry);
  EXPECT_EQ(fit_plane(point).error().code, Errc::PoorGeometry);
  EXPECT_EQ(fit_sphere(line).error().code, Errc::PoorGeometry);
  EXPECT_EQ(fit_sphere(point).error().code, Errc::PoorGeometry);
  EXPECT_EQ(fit_sphere(plate(500, 0)).error().code, Errc::PoorGeometry);  // a plane is a sphere without end
}

}  // namespace
}  // namespace relievo::pipeline::best_fit
