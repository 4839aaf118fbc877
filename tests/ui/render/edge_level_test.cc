// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/render/face_geometry.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory_resource>
#include <set>
#include <vector>

namespace relievo::ui {
namespace {

// A bowl of 120 mm radius, 275 x 275 vertices: 150,152 triangles, 0.6 mm apart.
pipeline::FaceMesh bowl(int side, float step_mm) {
  pipeline::FaceMesh mesh(std::pmr::get_default_resource());
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      const float x = (static_cast<float>(c) - static_cast<float>(side) / 2) * step_mm,
                  y = (static_cast<float>(r) - static_cast<float>(side) / 2) * step_mm;
      mesh.vertices_mm.push_back({x, y, std::sqrt(std::max(0.0F, 120 * 120 - x * x - y * y))});
    }
  const auto at = [side](int r, int c) { return static_cast<std::uint32_t>(r * side + c); };
  for (int r = 0; r + 1 < side; ++r)
    for (int c = 0; c + 1 < side; ++c) {
      mesh.triangles.push_back({at(r, c), at(r + 1, c), at(r, c + 1)});
      mesh.triangles.push_back({at(r, c + 1), at(r + 1, c), at(r + 1, c + 1)});
    }
  return mesh;
}

float length(const pipeline::FaceMesh& mesh, const std::array<std::uint32_t, 2>& edge) {
  const auto &a = mesh.vertices_mm[edge[0]], &b = mesh.vertices_mm[edge[1]];
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

TEST(EdgeLevel, OfAFineMeshAsManySidesAsTheSpacingAllows) {
  const pipeline::FaceMesh mesh = bowl(275, 0.6F);
  ASSERT_GT(mesh.triangles.size(), 150000U);
  for (const float least_mm : {3.0F, 6.0F}) {
    const Edges edges = edges_of(mesh, least_mm);
    std::set<std::uint32_t> used;
    double sum = 0;
    for (const auto& edge : edges) {
      EXPECT_LT(edge[0], edge[1]);
      EXPECT_GE(length(mesh, edge), least_mm);
      EXPECT_LT(length(mesh, edge), 4 * least_mm);
      sum += static_cast<double>(length(mesh, edge));
      used.insert(edge.begin(), edge.end());
    }
    EXPECT_LT(sum / static_cast<double>(edges.size()), 1.8 * static_cast<double>(least_mm));
    // A net of triangles over all of it: V - E + F = 1, 3 F < 2 E.
    EXPECT_GT(static_cast<double>(edges.size()), 2.5 * static_cast<double>(used.size()));
    EXPECT_LT(edges.size(), 3 * used.size());
    EXPECT_GT(static_cast<double>(used.size()) * static_cast<double>(least_mm * least_mm), 0.6 * 164 * 164)
        << "no part is left out";
  }
}

TEST(EdgeLevel, AMeshThatIsCoarseKeepsEverySide) {
  const pipeline::FaceMesh mesh = bowl(12, 8);
  std::set<std::array<std::uint32_t, 2>> own;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      own.insert({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  EXPECT_EQ(edges_of(mesh, 3), Edges(own.begin(), own.end()));
  EXPECT_TRUE(edges_of(pipeline::FaceMesh(std::pmr::get_default_resource()), 3).empty());
}

// So few that what is between them is seen, and no part without.
TEST(DotsOfAMesh, SomeStandApartAndComeFirst) {
  std::vector<Dot> dots;
  for (const auto& v : bowl(275, 0.6F).vertices_mm) dots.push_back({v.x, v.y, v.z});
  const std::size_t all = dots.size(), apart = set_apart(dots);
  EXPECT_EQ(dots.size(), all);
  const auto cube = [](const Dot& d) {
    return std::array{std::lround(d.x / kApartMm), std::lround(d.y / kApartMm), std::lround(d.z / kApartMm)};
  };
  std::set<std::array<long, 3>> first, whole;
  for (std::size_t i = 0; i < all; ++i) {
    whole.insert(cube(dots[i]));
    if (i < apart) first.insert(cube(dots[i]));
  }
  EXPECT_EQ(first.size(), apart);
  EXPECT_EQ(first, whole);
  EXPECT_LT(apart, all / 10);
}

}  // namespace
}  // namespace relievo::ui
