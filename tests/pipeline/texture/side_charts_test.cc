// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <numbers>
#include <vector>

#include "pipeline/model/face_mesh.h"
#include "pipeline/texture/chart/chart.h"

namespace relievo::pipeline {
namespace {

// A ramp that winds twice around the line of sight: all of it faces one way, and one turn lies above the
// other.
FaceMesh winding_ramp() {
  constexpr int kAround = 120, kAcross = 8;
  FaceMesh mesh(std::pmr::get_default_resource());
  for (int i = 0; i <= kAround; ++i)
    for (int j = 0; j <= kAcross; ++j) {
      const double angle = 4 * std::numbers::pi * i / kAround, radius = 6 + j;
      mesh.vertices_mm.push_back(
          {float(radius * std::cos(angle)), float(radius * std::sin(angle)), float(2 * angle)});
    }
  const auto at = [](int i, int j) { return std::uint32_t(i * (kAcross + 1) + j); };
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kAcross; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  return mesh;
}

bool holds(const Vec2f* corner, const Vec2f& p) {
  const auto side = [&](const Vec2f& a, const Vec2f& b) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  const float s[] = {side(corner[0], corner[1]), side(corner[1], corner[2]), side(corner[2], corner[0])};
  return std::ranges::all_of(s, [](float v) { return v > 0; }) ||
         std::ranges::all_of(s, [](float v) { return v < 0; });
}

TEST(SideCharts, NoPlaceOfTheAtlasIsOnTwoTriangles) {
  const FaceMesh mesh = winding_ramp();
  const std::vector<std::uint8_t> kept(mesh.triangles.size(), 0), photographed(mesh.vertices_mm.size(), 1);
  Chart main(std::pmr::get_default_resource());
  main.height_px = 1024;
  const SideCharts sides =
      lay_out_sides(mesh, main, kept, photographed, 6, 2048, std::pmr::get_default_resource());
  ASSERT_EQ(sides.triangles.size(), mesh.triangles.size());
  int twice = 0;
  for (std::size_t s = 0; s < sides.triangles.size(); ++s) {
    const Vec2f* c = &sides.corner[3 * s];
    const Vec2f middle{(c[0].x + c[1].x + c[2].x) / 3, (c[0].y + c[1].y + c[2].y) / 3};
    for (std::size_t other = 0; other < sides.triangles.size(); ++other)
      twice += other != s && holds(&sides.corner[3 * other], middle) ? 1 : 0;
  }
  EXPECT_EQ(twice, 0);
}

}  // namespace
}  // namespace relievo::pipeline
