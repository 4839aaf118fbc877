// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/model/vector3.h"
#include "tests/pipeline/mesh/mesh_checks.h"

namespace relievo::pipeline {
namespace {

constexpr int kSheetSide = 12;  // vertices

// A flat sheet a millimetre a cell, counter-clockwise seen from -z, without the cells that `hole` names.
template <typename Hole>
FaceMesh sheet(Hole&& hole, std::uint32_t side = kSheetSide) {
  FaceMesh mesh(std::pmr::get_default_resource());
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) mesh.vertices_mm.push_back({float(x), float(y), 0});
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      if (hole(int(x), int(y))) continue;
      const std::uint32_t a = y * side + x;
      mesh.triangles.push_back({a, a + side, a + side + 1});
      mesh.triangles.push_back({a, a + side + 1, a + 1});
    }
  return mesh;
}

float area(const FaceMesh& mesh) {
  float sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3f& a = mesh.vertices_mm[t[0]];
    sum += cross(minus(mesh.vertices_mm[t[1]], a), minus(mesh.vertices_mm[t[2]], a)).z / 2;
  }
  return std::abs(sum);
}

auto mouths(float mm) {
  return [mm](const Vec3f&) { return mm; };
}

std::vector<Vec3f> outwards(const FaceMesh& mesh) { return {mesh.vertices_mm.size(), Vec3f{0, 0, -1}}; }

TEST(Rims, AreTheEdgesOfOneTriangle) {
  const FaceMesh mesh = sheet([](int, int) { return false; });
  const auto border = border_edges(mesh.triangles, std::pmr::get_default_resource());
  EXPECT_EQ(border.size(), 4U * (kSheetSide - 1));
  for (const BorderEdge& e : border)
    EXPECT_FLOAT_EQ(distance(mesh.vertices_mm[e[0]], mesh.vertices_mm[e[1]]), 1);
}

TEST(Rims, OfHolesAreClosedAndTheOutlineIsNot) {
  FaceMesh mesh = sheet([](int x, int y) { return x >= 4 && x < 7 && y >= 4 && y < 6; });
  const auto border = border_edges(mesh.triangles, std::pmr::get_default_resource());
  const std::size_t before = mesh.triangles.size(), vertices = mesh.vertices_mm.size();
  const auto beside =
      close_holes(mesh.vertices_mm, outwards(mesh), border, {15, mouths(0)}, mesh.triangles).beside;
  EXPECT_EQ(mesh.vertices_mm.size(), vertices + beside.size());
  EXPECT_GE(mesh.triangles.size(), before + 12U) << "about as dense as the sheet";
  EXPECT_LE(mesh.triangles.size(), before + 24U);
  for (std::size_t t = before; t < mesh.triangles.size(); ++t)
    EXPECT_GE(*std::ranges::max_element(mesh.triangles[t]), vertices) << "none of measured vertices alone";
  for (const std::uint32_t v : beside)
    EXPECT_TRUE(std::ranges::any_of(border, [&](const BorderEdge& e) { return e[0] == v; }));
  EXPECT_NEAR(area(mesh), (kSheetSide - 1) * (kSheetSide - 1), 1e-3) << "closed, and facing the same way";
  EXPECT_EQ(border_edges(mesh.triangles, std::pmr::get_default_resource()).size(), 4U * (kSheetSide - 1));
}

TEST(Rims, OfLargeHolesStayOpen) {
  FaceMesh mesh = sheet([](int x, int y) { return x >= 4 && x < 7 && y >= 4 && y < 6; });
  const auto border = border_edges(mesh.triangles, std::pmr::get_default_resource());
  close_holes(mesh.vertices_mm, outwards(mesh), border, {9, mouths(0)}, mesh.triangles);
  EXPECT_NEAR(area(mesh), (kSheetSide - 1) * (kSheetSide - 1) - 6, 1e-3);
}

// Two triangles bent along their common edge: the least area across their rim is theirs over again.
TEST(Rims, WhoseClosingNeedsAnEdgeThatIsThereStayOpenAndAreNamed) {
  FaceMesh mesh = sheet([](int x, int y) { return x == 5 && y == 5; });
  const auto p = std::uint32_t(mesh.vertices_mm.size()), r = p + 1, q = p + 2, s = p + 3;
  for (const Vec3f& v : {Vec3f{5, 5, 9}, Vec3f{5.2F, 6, 9}, Vec3f{5.4F, 5, 9}, Vec3f{5.2F, 5, 10}})
    mesh.vertices_mm.push_back(v);
  mesh.triangles.push_back({p, r, q});
  mesh.triangles.push_back({p, q, s});
  const auto border = border_edges(mesh.triangles, std::pmr::get_default_resource());
  auto left_open =
      close_holes(mesh.vertices_mm, outwards(mesh), border, {15, mouths(0)}, mesh.triangles).left_open;
  std::ranges::sort(left_open);
  EXPECT_EQ(left_open, (std::vector<std::uint32_t>{p, r, q, s}));
  EXPECT_EQ(border_edges(mesh.triangles, std::pmr::get_default_resource()).size(), 4U * (kSheetSide - 1) + 4U)
      << "the outline and what stays open: the sheet's own hole is closed";
}

TEST(Rims, LoseTheBaysOfTheOutline) {
  // From the right edge a bay two cells wide and five deep; from the lower one a dent a cell deep, which is
  // none.
  FaceMesh mesh = sheet(
      [](int x, int y) { return (x >= kSheetSide - 6 && y >= 4 && y < 6) || (y == 0 && x >= 2 && x < 4); });
  const auto border = border_edges(mesh.triangles, std::pmr::get_default_resource());
  const std::size_t before = mesh.triangles.size();
  close_holes(mesh.vertices_mm, outwards(mesh), border, {20, mouths(1.5F)}, mesh.triangles);
  EXPECT_EQ(mesh.triangles.size(), before) << "too wide";
  close_holes(mesh.vertices_mm, outwards(mesh), border, {20, mouths(3)}, mesh.triangles);
  EXPECT_NEAR(area(mesh), (kSheetSide - 1) * (kSheetSide - 1) - 2, 1e-3)
      << "closed straight, and facing the same way";
}

TEST(Rims, LoseWiderBaysWhereTheyMay) {
  // Two alike, from the left edge and from the right.
  FaceMesh mesh = sheet([](int x, int y) { return (x >= kSheetSide - 6 || x < 5) && y >= 4 && y < 6; });
  const auto border = border_edges(mesh.triangles, std::pmr::get_default_resource());
  const auto wide_to_the_left = [](const Vec3f& headland) { return headland.x < 3 ? 3.0F : 1.5F; };
  close_holes(mesh.vertices_mm, outwards(mesh), border, {40, wide_to_the_left}, mesh.triangles);
  EXPECT_NEAR(area(mesh), (kSheetSide - 1) * (kSheetSide - 1) - 10, 1e-3);
  for (const Vec3f& v : mesh.vertices_mm) EXPECT_TRUE(v.y == std::round(v.y) || v.x < 6);
}

TEST(Rims, LoseTheirCornersAsRoundAsADisc) {
  constexpr int kWide = 61;
  constexpr float kRadius = 16, kWidth = kWide - 1, kPi = 3.14159265F;
  FaceMesh mesh = sheet([](int, int) { return false; }, kWide);
  const std::vector<std::uint8_t> sure(mesh.vertices_mm.size(), 0);
  open_rims(mesh.vertices_mm, sure, mesh.triangles, kRadius, 0, std::pmr::get_default_resource());
  const float lost = kWidth * kWidth - area(mesh), corners = (4 - kPi) * kRadius * kRadius;
  EXPECT_NEAR(lost, corners, 0.35F * corners) << "a millimetre of slack along every corner";
  for (const BorderEdge& e : border_edges(mesh.triangles, std::pmr::get_default_resource())) {
    const Vec3f& v = mesh.vertices_mm[e[0]];
    const float x = std::min(v.x, kWidth - v.x), y = std::min(v.y, kWidth - v.y);
    const float to_disc = std::hypot(kRadius - x, kRadius - y) - kRadius;
    if (x < kRadius && y < kRadius) {
      EXPECT_NEAR(to_disc, 0, 1.5F) << v.x << ", " << v.y;
    } else {
      EXPECT_EQ(std::min(x, y), 0) << "straight sides stay";
    }
  }
}

TEST(Rims, LoseTheirThreadsAndKeepTheRest) {
  // A thread one cell wide between two halves.
  FaceMesh mesh = sheet([](int x, int y) { return x >= 4 && x < 7 && y != 5; });
  const float before = area(mesh);
  std::vector<std::uint8_t> sure(mesh.vertices_mm.size(), 1);
  open_rims(mesh.vertices_mm, sure, mesh.triangles, 1, 0, std::pmr::get_default_resource());
  EXPECT_EQ(area(mesh), before) << "all of it is sure";
  FaceMesh held = mesh;
  open_rims(held.vertices_mm, sure, held.triangles, 1, 2, std::pmr::get_default_resource());
  EXPECT_EQ(area(held), before) << "joined by two vertices on either side";
  open_rims(held.vertices_mm, sure, held.triangles, 1, 5, std::pmr::get_default_resource());
  EXPECT_GE(before - area(held), 3) << "it hangs on by less than asked";
  std::fill(sure.begin(), sure.end(), std::uint8_t{0});
  open_rims(mesh.vertices_mm, sure, mesh.triangles, 1, 0, std::pmr::get_default_resource());
  EXPECT_GE(before - area(mesh), 3) << "the thread";
  EXPECT_LE(before - area(mesh), 6) << "and little else";
  for (const auto& t : mesh.triangles) {
    const float x = (mesh.vertices_mm[t[0]].x + mesh.vertices_mm[t[1]].x + mesh.vertices_mm[t[2]].x) / 3;
    EXPECT_TRUE(x < 5 || x > 6) << x;
  }
}

TEST(Rims, AreStraightenedByAtMostSoMuch) {
  FaceMesh mesh = sheet([](int, int) { return false; });
  for (int x = 1; x + 1 < kSheetSide; x += 2)
    mesh.vertices_mm[static_cast<std::size_t>(x)].y -= 0.4F;  // teeth
  const auto border = border_edges(mesh.triangles, std::pmr::get_default_resource());
  const std::pmr::vector<Vec3f> before = mesh.vertices_mm;
  smooth_rims(mesh.vertices_mm, border, 20, 0.3F, std::pmr::get_default_resource());
  float rough_before = 0, rough = 0;
  for (std::size_t x = 3; x + 4 < kSheetSide; ++x) {
    rough_before += std::abs(before[x].y - before[x + 1].y);
    rough += std::abs(mesh.vertices_mm[x].y - mesh.vertices_mm[x + 1].y);
  }
  EXPECT_LT(rough, rough_before / 4);
  for (std::size_t v = 0; v < before.size(); ++v)
    EXPECT_LE(distance(before[v], mesh.vertices_mm[v]), 0.3001F);
}

}  // namespace
}  // namespace relievo::pipeline
