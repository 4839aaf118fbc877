// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <set>
#include <stdexcept>

#include "pipeline/fuse/rim.h"
#include "pipeline/mesh/completion/mesh_laplacian.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr int kStepSide = 41;

// A sheet of triangles with sides of a millimetre; `height` of what lies to the right of its middle.
struct Sheet {
  explicit Sheet(float height) {
    for (int y = 0; y < kStepSide; ++y)
      for (int x = 0; x < kStepSide; ++x) {
        vertices.push_back({static_cast<float>(x), static_cast<float>(y), x > kStepSide / 2 ? height : 0});
        label.push_back(x > kStepSide / 2 ? 2 : 1);
        stays.push_back(x == 0 || y == 0 || x == kStepSide - 1 || y == kStepSide - 1 ? 1 : 0);
      }
    for (std::uint32_t y = 0; y + 1 < kStepSide; ++y)
      for (std::uint32_t x = 0; x + 1 < kStepSide; ++x) {
        const std::uint32_t k = y * kStepSide + x;
        triangles.push_back({k, k + 1, k + kStepSide});
        triangles.push_back({k + 1, k + kStepSide + 1, k + kStepSide});
      }
  }
  std::pmr::vector<float> smooth() {
    std::vector<std::uint8_t> part(vertices.size(), 0);
    add_steps(vertices, triangles, label, part, std::pmr::get_default_resource());
    return fair_part(vertices, triangles, part, stays, std::pmr::get_default_resource());
  }
  float steepest() const {
    float most = 0;
    for (int x = 0; x + 1 < kStepSide; ++x) {
      const std::size_t k = kStepSide * (kStepSide / 2) + static_cast<std::size_t>(x);
      most = std::max(most, std::abs(vertices[k + 1].z - vertices[k].z));
    }
    return most;
  }
  std::vector<Vec3f> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> label, stays;
};

TEST(Steps, BetweenTwoPosesAreLaidAnew) {
  Sheet sheet(1.2F);
  const std::vector<Vec3f> before = sheet.vertices;
  const auto moved = sheet.smooth();
  EXPECT_LT(sheet.steepest(), 0.35F);
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_NEAR(moved[v], std::abs(sheet.vertices[v].z - before[v].z), 0.25F) << v;
    if (std::abs(before[v].x - kStepSide / 2) > 8) {
      EXPECT_EQ(sheet.vertices[v].z, before[v].z) << "far away";
    }
  }
}

TEST(Steps, OfOnePoseAreSkin) {
  Sheet sheet(1.2F);
  std::fill(sheet.label.begin(), sheet.label.end(), std::uint8_t{1});
  const auto moved = sheet.smooth();
  EXPECT_TRUE(std::all_of(moved.begin(), moved.end(), [](float d) { return d == 0; }));
}

TEST(Steps, ThatAreLowStay) {
  Sheet sheet(0.3F);
  const auto moved = sheet.smooth();
  EXPECT_TRUE(std::all_of(moved.begin(), moved.end(), [](float d) { return d == 0; }));
}

TEST(Steps, BesideWhichTheSurfaceTurnsAreFolds) {
  Sheet sheet(1.2F);
  for (Vec3f& v : sheet.vertices)
    if (v.x > kStepSide / 2) v.z += 1.5F * (v.x - kStepSide / 2 - 1);  // 56 degrees
  const auto moved = sheet.smooth();
  EXPECT_TRUE(std::all_of(moved.begin(), moved.end(), [](float d) { return d == 0; }));
}

TEST(Folds, AreLaidAnewWhereTheSurfaceIsUnsure) {
  constexpr std::size_t kCrumb = kStepSide * (kStepSide / 2) + kStepSide / 2;
  const auto height = [](std::uint8_t unsure_there) {
    Sheet sheet(0);
    sheet.vertices[kCrumb].z = 1.5F;
    std::vector<std::uint8_t> part(sheet.vertices.size(), 0), unsure(part.size(), unsure_there);
    add_folds(sheet.vertices, sheet.triangles, unsure, part, std::pmr::get_default_resource());
    fair_part(sheet.vertices, sheet.triangles, part, sheet.stays, std::pmr::get_default_resource());
    return sheet.vertices[kCrumb].z;
  };
  EXPECT_LT(std::abs(height(1)), 0.1F);
  EXPECT_EQ(height(0), 1.5F) << "what is sure is skin";
}

TEST(Folds, ThatAreTurnedOverAreUnfolded) {
  constexpr std::size_t kMiddle = kStepSide * (kStepSide / 2) + kStepSide / 2;
  Sheet sheet(0);
  const std::vector<Vec3f> flat = sheet.vertices;
  sheet.vertices[kMiddle].x += 1.8F;  // beyond its neighbour
  sheet.vertices[0].x += 3;           // of the rim
  unfold(sheet.vertices, sheet.triangles, std::pmr::get_default_resource());
  for (const Triangle& t : sheet.triangles) {
    if (t[0] < 3) continue;
    const Vec3f& a = sheet.vertices[t[0]];
    EXPECT_GT(cross(minus(sheet.vertices[t[1]], a), minus(sheet.vertices[t[2]], a)).z, 0);
  }
  EXPECT_EQ(sheet.vertices[0].x, 3) << "a rim stays";
  for (std::size_t v = 1; v < flat.size(); ++v)
    if (distance(flat[v], flat[kMiddle]) > 4 && flat[v].x + flat[v].y > 4) {
      EXPECT_EQ(sheet.vertices[v].x, flat[v].x) << "far away";
    }
}

// A dome with a hole of two centimetres: closed flat it would lie 1.3 mm too low.
TEST(Fairing, LetsWhatClosesAHoleGoOnAsTheSurfaceDoes) {
  constexpr float kRadius = 40, kHole = 10, kStep = 1;
  constexpr int kHalf = 20;
  std::pmr::vector<Vec3f> vertices;
  std::pmr::vector<Triangle> triangles;
  std::vector<Vec3f> normals;
  for (int y = -kHalf; y <= kHalf; ++y)
    for (int x = -kHalf; x <= kHalf; ++x) {
      const float u = kStep * static_cast<float>(x), v = kStep * static_cast<float>(y);
      vertices.push_back({u, v, std::sqrt(kRadius * kRadius - u * u - v * v)});
      normals.push_back(vertices.back());
    }
  const auto index = [](int x, int y) {
    return static_cast<std::uint32_t>((y + kHalf) * (2 * kHalf + 1) + x + kHalf);
  };
  for (int y = -kHalf; y < kHalf; ++y)
    for (int x = -kHalf; x < kHalf; ++x) {
      if (std::hypot(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) < kHole) continue;
      triangles.push_back({index(x, y), index(x + 1, y), index(x + 1, y + 1)});
      triangles.push_back({index(x, y), index(x + 1, y + 1), index(x, y + 1)});
    }
  vertices.push_back({0, 0, 0});  // its triangles went when rims were trimmed
  normals.push_back({0, 0, 1});
  const std::size_t before = vertices.size();
  const auto border = border_edges(triangles, std::pmr::get_default_resource());
  ASSERT_FALSE(close_holes(vertices, normals, border, {100, [](const Vec3f&) { return 0.0F; }}, triangles)
                   .beside.empty());
  const auto furthest = [&] {
    float most = 0;
    for (std::size_t v = before; v < vertices.size(); ++v)
      most = std::max(most, std::abs(length(vertices[v]) - kRadius));
    return most;
  };
  EXPECT_GT(furthest(), 0.8F);
  std::vector<std::uint8_t> part(vertices.size(), 0), stays(vertices.size(), 0);
  std::fill(part.begin() + static_cast<std::ptrdiff_t>(before) - 1, part.end(), std::uint8_t{1});
  for (const BorderEdge& e : border_edges(triangles, std::pmr::get_default_resource())) stays[e[0]] = 1;
  const auto moved = fair_part(vertices, triangles, part, stays, std::pmr::get_default_resource());
  EXPECT_LT(furthest(), 0.1F);
  for (std::size_t v = 0; v < before; ++v) EXPECT_EQ(moved[v], 0) << "what was there stays";
}

TEST(Fairing, LaysNoTwoVerticesOnOnePlace) {
  Sheet two(0);
  const Sheet second(0);
  const auto first = static_cast<std::uint32_t>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), second.vertices.begin(), second.vertices.end());
  two.stays.insert(two.stays.end(), second.stays.begin(), second.stays.end());
  for (const Triangle& t : second.triangles)
    two.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  const std::vector<std::uint8_t> part(two.vertices.size(), 1);
  fair_part(two.vertices, two.triangles, part, two.stays, std::pmr::get_default_resource());
  std::set<std::array<float, 3>> places;
  for (std::size_t v = 0; v < two.vertices.size(); ++v) {
    const Vec3f& at = two.vertices[v];
    if (two.stays[v] != 0) continue;
    EXPECT_TRUE(places.insert({at.x, at.y, at.z}).second) << v;
    EXPECT_NEAR(at.z, 0, 0.01F);
  }
}

// Between two slopes that rise at 45 degrees a thin plate rises further.
TEST(Fairing, DoesNotBulgeOutOfAWideGap) {
  const auto top = [](double tension_mm) {
    const Sheet sheet(0);
    std::vector<Eigen::Vector3d> at;
    std::vector<char> free;
    for (const Vec3f& v : sheet.vertices) {
      const double x = 1.5 * static_cast<double>(v.x), y = 1.5 * static_cast<double>(v.y);
      at.emplace_back(x, y, std::min({x - 10, 50 - x, 0.0}));
      free.push_back(x >= 10 && x <= 50 ? 1 : 0);
    }
    fair(at, sheet.triangles, free, tension_mm);
    return at[kStepSide * (kStepSide / 2) + kStepSide / 2].z();
  };
  EXPECT_GT(top(0), 5);
  EXPECT_LT(top(15), 0.85 * top(0));
  EXPECT_LT(top(5), 0.85 * top(15));
  EXPECT_GT(top(15), 0.25 * top(0)) << "it still goes on as the slopes do";
}

TEST(Fairing, SaysWhenASurfaceCannotBeLaid) {
  const Sheet sheet(0);
  std::vector<Eigen::Vector3d> at;
  for (const Vec3f& v : sheet.vertices) at.emplace_back(v.x, v.y, v.z);
  std::vector<char> free(at.size(), 0);
  free[kStepSide + 1] = 1;
  at[1].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fair(at, sheet.triangles, free), std::runtime_error);
  EXPECT_EQ(at[kStepSide + 1], Eigen::Vector3d(1, 1, 0)) << "as it was";
}

}  // namespace
}  // namespace relievo::pipeline
