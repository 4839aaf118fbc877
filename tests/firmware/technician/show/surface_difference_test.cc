// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two planes a millimetre apart differ by a millimetre, with its sign; a step has its own on each side.
#include "firmware/technician/show/technician_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/checks/deviation_picture.h"
#include "firmware/technician/show/technician_figures.h"

namespace relievo::firmware {
namespace {

constexpr double kPlaneMm = 560;

pipeline::RectifiedPair looking(double yaw = 0) {
  pipeline::RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = 480, pair.height_px = 300;
  pair.focal_px = 580, pair.baseline_mm = 108;
  pair.left_centre_px = {240, 150}, pair.right_centre_px = {190, 150};
  const double c = std::cos(yaw), s = std::sin(yaw), m[] = {c, 0, -s, 0, 1, 0, s, 0, c};
  std::copy(std::begin(m), std::end(m), pair.rectified_from_left.m);
  return pair;
}

// 120 mm square; its depth in the rectified view as told. Right of `from_x` mm it may stand elsewhere.
pipeline::FaceMesh plane(const pipeline::RectifiedPair& pair, double depth_mm, double step_mm = 0) {
  pipeline::FaceMesh mesh(std::pmr::get_default_resource());
  const pipeline::Rotation back = pipeline::transposed(pair.rectified_from_left);
  constexpr int kSteps = 60;
  for (int r = 0; r <= kSteps; ++r)
    for (int c = 0; c <= kSteps; ++c) {
      const double x = -60 + 2.0 * c, y = -60 + 2.0 * r;
      const auto v = apply(back, pipeline::Vec3d{x, y, depth_mm + (c > kSteps / 2 ? step_mm : 0)});
      mesh.vertices_mm.push_back({float(v.x), float(v.y), float(v.z)});
      mesh.normals.push_back({0, 0, -1});
    }
  for (std::uint32_t r = 0; r < kSteps; ++r)
    for (std::uint32_t c = 0; c < kSteps; ++c) {
      const std::uint32_t a = r * (kSteps + 1) + c, n = kSteps + 1;
      mesh.triangles.push_back({a, a + n, a + 1});
      mesh.triangles.push_back({a + 1, a + n, a + n + 1});
    }
  return mesh;
}

TEST(SurfaceDifference, OfPlanesAMillimetreApartIsAMillimetreWithItsSign) {
  for (const double yaw : {0.0, 0.1})
    for (const double apart : {1.0, -1.0, 0.25, 0.0}) {
      const pipeline::RectifiedPair pair = looking(yaw);
      const pipeline::FaceMesh nearer = plane(pair, kPlaneMm - apart);
      SurfaceDifference difference;
      difference.measure(pair, nearer, depths_of(pair, plane(pair, kPlaneMm)), 7);
      const ui::TechnicianDifference seen = difference.view();
      ASSERT_TRUE(seen.known);
      EXPECT_NEAR(seen.median_mm, apart, 0.01) << "nearer is positive";
      EXPECT_NEAR(seen.most_mm, std::abs(apart), 0.02);
      EXPECT_NEAR(difference.nearer_mm(240, 150), apart, 0.01);
      EXPECT_NEAR(difference.nearer_mm(200, 120), apart, 0.01);
      EXPECT_TRUE(std::isnan(difference.nearer_mm(5, 5))) << "no surface there";
      EXPECT_TRUE(std::isnan(difference.nearer_mm(-1, 0)));
    }
}

TEST(SurfaceDifference, ItsColoursAreThoseOfTheScaleOnTheMapAndOnTheSurface) {
  const pipeline::RectifiedPair pair = looking();
  const pipeline::FaceMesh stepped = plane(pair, kPlaneMm - 1, 2);  // left 1 mm nearer, right 1 mm farther
  SurfaceDifference difference;
  difference.measure(pair, stepped, depths_of(pair, plane(pair, kPlaneMm)), 7);
  difference.draw(pair, stepped, 2);
  const ui::TechnicianDifference seen = difference.view();
  ASSERT_FALSE(seen.map.pixels.empty());
  EXPECT_EQ(seen.map.version, 7U);
  const auto pixel = [&](double u, double v) {
    const FaceWindow window(pair, seen.map.pixels.width_px);
    const std::uint8_t* at = seen.map.pixels.row(int(window.y(v))) + 3 * int(window.x(u));
    return std::array<std::uint8_t, 3>{at[0], at[1], at[2]};
  };
  const auto is_near = [](const std::array<std::uint8_t, 3>& a, const std::array<std::uint8_t, 3>& b) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 3);
  };
  is_near(pixel(200, 150), deviation_colour(0.5));
  is_near(pixel(280, 150), deviation_colour(-0.5));
  ASSERT_NE(seen.colours, nullptr);
  ASSERT_EQ(seen.colours->uv.size(), 3 * stepped.triangles.size());
  const auto of_triangle = [&](std::size_t i) {
    const auto texel = std::size_t(seen.colours->uv[3 * i].x * float(seen.colours->width_px));
    return std::array<std::uint8_t, 3>{seen.colours->rgb[3 * texel], seen.colours->rgb[3 * texel + 1],
                                       seen.colours->rgb[3 * texel + 2]};
  };
  const std::size_t row = 30 * 120;  // triangles of the row in the middle
  is_near(of_triangle(row + 2 * 15), deviation_colour(0.5));
  is_near(of_triangle(row + 2 * 45), deviation_colour(-0.5));
}

TEST(SurfaceDifference, WhereOneIsMissingNothingIsKnown) {
  const pipeline::RectifiedPair pair = looking();
  const pipeline::FaceMesh mesh = plane(pair, kPlaneMm);
  SurfaceDifference difference;
  difference.measure(pair, mesh, compare::DisparityMap(pair.width_px, pair.height_px), 7);
  EXPECT_FALSE(difference.view().known);
  difference.measure(pair, mesh, compare::DisparityMap(10, 10), 8);
  EXPECT_FALSE(difference.view().known);
}

// The scale of the page, and how uncertain a surface is.
TEST(SigmaPercent, CountsTheMeasuredVerticesAlone) {
  pipeline::FaceMesh mesh(std::pmr::get_default_resource());
  const auto add = [&](float sigma, std::uint8_t measured) {
    mesh.sigma_mm.push_back(sigma);
    mesh.measured.push_back(measured);
  };
  add(0.005F, 1), add(0.03F, 1), add(0.035F, 1), add(9, 1), add(0.03F, 0);
  const auto percent = sigma_percent(mesh);
  EXPECT_FLOAT_EQ(percent[0], 25);
  EXPECT_FLOAT_EQ(percent[1], 50);
  EXPECT_FLOAT_EQ(percent.back(), 25) << "what is beyond the scale";
  EXPECT_FLOAT_EQ(sigma_percent(pipeline::FaceMesh(std::pmr::get_default_resource()))[0], 0);
}

}  // namespace
}  // namespace relievo::firmware
