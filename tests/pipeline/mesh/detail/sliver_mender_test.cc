// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/sliver_mender.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory_resource>
#include <random>

#include "tests/pipeline/mesh/mesh_checks.h"

namespace relievo::pipeline {
namespace {

// A sheet 500 mm away whose nodes are pushed about so far that many triangles become slivers.
struct Sheet {
  static constexpr std::uint32_t kSide = 40;
  std::vector<Vec3f> at;
  std::pmr::vector<Triangle> triangles;

  explicit Sheet(float push) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> shift(-push, push);
    for (std::uint32_t r = 0; r < kSide; ++r)
      for (std::uint32_t c = 0; c < kSide; ++c)
        at.push_back({static_cast<float>(c) + shift(random), static_cast<float>(r) + shift(random),
                      500 + shift(random)});
    for (std::uint32_t r = 0; r + 1 < kSide; ++r)
      for (std::uint32_t c = 0; c + 1 < kSide; ++c) {
        const std::uint32_t a = r * kSide + c;
        add({a, a + kSide, a + kSide + 1});
        add({a, a + kSide + 1, a + 1});
      }
  }
  void add(const Triangle& t) {
    const Vec3f n = cross(minus(at[t[1]], at[t[0]]), minus(at[t[2]], at[t[0]]));
    if (n.z < 0) triangles.push_back(t);  // towards the camera; what is folded over is left out
  }
  std::size_t slivers() const {
    return static_cast<std::size_t>(
        std::count_if(triangles.begin(), triangles.end(), [this](const Triangle& t) {
          return smallest_angle_deg(at[t[0]], at[t[1]], at[t[2]]) < kSmallestAngleDeg;
        }));
  }
};

TEST(SliverMender, MendsWhatCanBeMendedAndKeepsTheSurface) {
  Sheet sheet(0.42F);
  std::pmr::monotonic_buffer_resource memory;
  keep_one_surface(sheet.at, sheet.triangles, {}, &memory);
  const std::size_t before = sheet.slivers();
  const std::size_t triangles = sheet.triangles.size();
  const double area = area_mm2(sheet.at, sheet.triangles);
  ASSERT_GT(before, 30U);
  if (mend_slivers(sheet.at, sheet.triangles, 20, &memory) > 0)
    keep_one_surface(sheet.at, sheet.triangles, {.ear_passes = 0}, &memory);
  EXPECT_LT(sheet.slivers(), before / 10);
  EXPECT_LE(sheet.triangles.size(), triangles);
  EXPECT_NEAR(area_mm2(sheet.at, sheet.triangles), area, 0.02 * area);
  FaceMesh mesh(std::pmr::get_default_resource());
  mesh.vertices_mm.assign(sheet.at.begin(), sheet.at.end());
  mesh.triangles = sheet.triangles;
  expect_one_manifold_surface(mesh);
  for (const Triangle& t : sheet.triangles)
    EXPECT_LT(cross(minus(sheet.at[t[1]], sheet.at[t[0]]), minus(sheet.at[t[2]], sheet.at[t[0]])).z, 0)
        << "still towards the camera";
}

TEST(SliverMender, LeavesAGoodSurfaceAlone) {
  Sheet sheet(0.1F);
  const std::pmr::vector<Triangle> before = sheet.triangles;
  EXPECT_EQ(mend_slivers(sheet.at, sheet.triangles, 20, std::pmr::get_default_resource()), 0U);
  EXPECT_TRUE(sheet.triangles == before);
}

}  // namespace
}  // namespace relievo::pipeline
