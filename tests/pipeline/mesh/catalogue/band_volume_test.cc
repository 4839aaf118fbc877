// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/meshers/band_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory_resource>
#include <random>

#include "pipeline/model/vector3.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

BandVolume cube(int side) {
  const std::vector<Vec3f> ends{
      {0, 0, 0}, {static_cast<float>(side), static_cast<float>(side), static_cast<float>(side)}};
  return volume_around(ends, 1, 0, std::pmr::get_default_resource());
}

template <typename Value>
BandVolume filled(int side, Value&& value) {
  BandVolume volume = cube(side);
  for (int z = 0; z < volume.nz; ++z)
    for (int y = 0; y < volume.ny; ++y)
      for (int x = 0; x < volume.nx; ++x) volume.value[volume.index(x, y, z)] = value(x, y, z, volume);
  return volume;
}

// Every directed edge once, and its opposite too: closed, and wound one way.
void expect_closed(const Polygonised& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.count({edge.second, edge.first}));
  }
}

TEST(BandVolume, ABallIsABall) {
  const Vec3f middle{10.3F, 10.6F, 9.8F};
  const BandVolume volume = filled(
      20, [&](int x, int y, int z, const BandVolume& v) { return length(minus(v.at(x, y, z), middle)) - 7; });
  const Polygonised ball = polygonise(volume, std::pmr::get_default_resource());
  expect_closed(ball);
  for (const Vec3f& v : ball.vertices_mm) EXPECT_NEAR(length(minus(v, middle)), 7, 0.03);
  double volume_mm3 = 0;
  for (const Triangle& t : ball.triangles)
    volume_mm3 += static_cast<double>(dot(
                      minus(ball.vertices_mm[t[0]], middle),
                      cross(minus(ball.vertices_mm[t[1]], middle), minus(ball.vertices_mm[t[2]], middle)))) /
                  6;
  EXPECT_NEAR(volume_mm3, 4.0 / 3 * 3.14159265 * 343, 25) << "positive: counter-clockwise seen from outside";
  EXPECT_EQ(static_cast<long>(ball.vertices_mm.size()) - static_cast<long>(ball.triangles.size()) / 2, 2)
      << "Euler: V - T/2";
}

// White noise is nothing but ambiguous faces.
TEST(BandVolume, NoAmbiguityTearsASurface) {
  std::mt19937 random(8);
  std::normal_distribution<float> noise(0, 1);
  const BandVolume volume = filled(16, [&](int x, int y, int z, const BandVolume& v) {
    const bool border = x == 0 || y == 0 || z == 0 || x + 1 == v.nx || y + 1 == v.ny || z + 1 == v.nz;
    const float n = noise(random);
    return border ? 1.0F : n;
  });
  const Polygonised surface = polygonise(volume, std::pmr::get_default_resource());
  EXPECT_GT(surface.triangles.size(), 5000U);
  expect_closed(surface);
}

// A checkered column of one cell: outside at (0, 0) and (1, 1). Where the saddle is outside, those two are
// one, and the sheets of triangles cut the inner corners off; where it is inside, the other way round.
TEST(BandVolume, TheSaddleDecides) {
  for (const float high : {3.0F, 0.4F}) {
    BandVolume volume(std::pmr::get_default_resource());
    volume.nx = volume.ny = volume.nz = 2;
    for (int k = 0; k < 8; ++k) volume.value.push_back((k & 1) == (k >> 1 & 1) ? high : -1.0F);
    const Polygonised surface = polygonise(volume, std::pmr::get_default_resource());
    ASSERT_EQ(surface.triangles.size(), 8U);
    for (const Triangle& t : surface.triangles) {
      Vec3f middle{};
      for (const std::uint32_t v : t) middle = plus(middle, times(surface.vertices_mm[v], 1 / 3.0F));
      const bool beside_an_inner_corner = std::abs(middle.x - middle.y) > std::abs(middle.x + middle.y - 1);
      EXPECT_EQ(beside_an_inner_corner, high > 1) << "the saddle is (high^2 - 1) / (2 high + 2)";
    }
  }
}

TEST(FillField, StopsWhenTold) {
  test::StageFixture room;
  const FieldPoint point{{5, 5, 5}, {0, 0, 1}, 1};
  BandVolume volume = cube(10);
  const auto fill = [&] {
    fill_field({&point, 1}, 2, volume, room.context);
    return std::isnan(volume.value[volume.index(5, 5, 5)]);
  };
  EXPECT_FALSE(fill());
  room.cancelled = true;
  EXPECT_TRUE(fill());
}

TEST(BandVolume, OutsideTheBandThereIsNothing) {
  const BandVolume volume = filled(12, [](int x, int, int z, const BandVolume&) {
    return x > 6 ? std::nanf("") : static_cast<float>(z) - 5.5F;
  });
  const Polygonised sheet = polygonise(volume, std::pmr::get_default_resource());
  EXPECT_GT(sheet.triangles.size(), 50U);
  for (const Vec3f& v : sheet.vertices_mm) {
    EXPECT_LE(v.x, 6);
    EXPECT_NEAR(v.z, 5.5, 1e-5);
  }
}

}  // namespace
}  // namespace relievo::pipeline
