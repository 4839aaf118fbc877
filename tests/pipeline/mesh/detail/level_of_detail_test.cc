// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/detail/level_of_detail.h"

#include <gtest/gtest.h>

#include <memory_resource>
#include <random>

#include "pipeline/mesh/meshers/grid_mesher.h"
#include "pipeline/mesh/surface_cleaner.h"
#include "tests/pipeline/mesh/mesh_checks.h"
#include "tests/pipeline/mesh/stage_room.h"
#include "tests/pipeline/mesh/truth_cloud.h"

namespace relievo::pipeline {
namespace {

// A textured ball's cap: two charts, seam along x = 0, uv by where a vertex lies.
FaceModel ball(double noise_mm = 0) {
  StageRoom room;
  auto mesh = room.run([&](StageContext& c) {
    return GridMesher({}).mesh(
        formula_cloud(
            2, 400, [](double sx, double sy) { return sphere_depth(sx, sy, 600, 90); }, noise_mm),
        c);
  });
  FaceModel model(std::pmr::get_default_resource());
  if (!mesh) return model;
  model.mesh = *mesh;
  model.texture.width_px = model.texture.height_px = 4;
  model.texture.rgb.assign(48, 100);
  for (const Vec3f& v : model.mesh.vertices_mm)
    model.texture.vertex_rgb.insert(
        model.texture.vertex_rgb.end(),
        {static_cast<std::uint8_t>(v.x + 100), static_cast<std::uint8_t>(v.y + 100), 7});
  for (const auto& t : model.mesh.triangles) {
    float middle = 0;
    for (const std::uint32_t v : t) middle += model.mesh.vertices_mm[v].x;
    for (const std::uint32_t v : t) {
      const Vec3f& at = model.mesh.vertices_mm[v];
      model.texture.uv.push_back({(middle < 0 ? 0.25F : 0.75F) + at.x / 800, 0.5F + at.y / 400});
    }
  }
  return model;
}

TEST(LevelOfDetail, FewerTrianglesWithinTheStatedErrorAndTheSameTexture) {
  const FaceModel model = ball(0.02);
  for (const int triangles : {20'000, 5000, 2000}) {
    DetailOptions options;
    options.triangles = triangles;
    const auto light = lighten(model, options, std::pmr::get_default_resource());
    ASSERT_TRUE(light);
    const FaceMesh& m = light->model.mesh;
    EXPECT_LE(m.triangles.size(), static_cast<std::size_t>(triangles));
    expect_clean(m);
    EXPECT_LT(light->rms_error_mm, 0.1);
    EXPECT_LE(light->max_error_mm, 0.5);
    // The ball itself is the truth: vertices are the model's, and between them it is as round as stated.
    double worst = 0;
    for (const auto& t : m.triangles) {
      const Vec3f middle =
          times(plus(plus(m.vertices_mm[t[0]], m.vertices_mm[t[1]]), m.vertices_mm[t[2]]), 1 / 3.0F);
      worst = std::max(worst, std::abs(90 - static_cast<double>(length(minus(middle, {0, 0, 600})))));
    }
    EXPECT_LT(worst, light->max_error_mm + 0.12) << "noise is 0.02 mm";
    // A texture coordinate still says where its vertex lies, on its side of the seam.
    for (std::size_t i = 0; i < light->model.texture.uv.size(); ++i) {
      const Vec3f& at = m.vertices_mm[m.triangles[i / 3][i % 3]];
      const float chart = light->model.texture.uv[i].x - at.x / 800;
      EXPECT_TRUE(std::abs(chart - 0.25F) < 1e-4F || std::abs(chart - 0.75F) < 1e-4F);
      EXPECT_NEAR(light->model.texture.uv[i].y, 0.5F + at.y / 400, 1e-4F);
    }
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const auto chart = [&](std::size_t k) {
        return light->model.texture.uv[3 * t + k].x - m.vertices_mm[m.triangles[t][k]].x / 800 < 0.5F;
      };
      EXPECT_TRUE(chart(0) == chart(1) && chart(1) == chart(2)) << "no triangle lies across the seam";
    }
    for (std::size_t v = 0; v < m.vertices_mm.size(); ++v)
      EXPECT_EQ(light->model.texture.vertex_rgb[3 * v], static_cast<std::uint8_t>(m.vertices_mm[v].x + 100));
    EXPECT_EQ(light->model.texture.rgb, model.texture.rgb);
    EXPECT_NEAR(area_mm2(m.vertices_mm, m.triangles), area_mm2(model.mesh.vertices_mm, model.mesh.triangles),
                0.005 * area_mm2(m.vertices_mm, m.triangles))
        << "the border stays";
  }
}

// A fused head says of each vertex which pair measured it.
TEST(LevelOfDetail, EveryVertexKeepsItsPose) {
  FaceModel model = ball();
  for (const Vec3f& v : model.mesh.vertices_mm) model.mesh.pose.push_back(v.x < 0 ? 1 : 2);
  DetailOptions options;
  options.triangles = 2000;
  const auto light = lighten(model, options, std::pmr::get_default_resource());
  ASSERT_TRUE(light);
  const FaceMesh& m = light->model.mesh;
  ASSERT_LT(m.vertices_mm.size(), model.mesh.vertices_mm.size());
  ASSERT_EQ(m.pose.size(), m.vertices_mm.size());
  for (std::size_t v = 0; v < m.pose.size(); ++v) EXPECT_EQ(m.pose[v], m.vertices_mm[v].x < 0 ? 1 : 2);
  model.mesh.pose.pop_back();
  EXPECT_FALSE(lighten(model, options, std::pmr::get_default_resource()));
}

TEST(LevelOfDetail, TheErrorIsATrueBound) {
  const FaceModel model = ball();
  DetailOptions options;
  options.triangles = 300;
  options.max_error_mm = 0.05;
  const auto light = lighten(model, options, std::pmr::get_default_resource());
  ASSERT_TRUE(light);
  EXPECT_LE(light->max_error_mm, 0.05);
  EXPECT_GT(light->model.mesh.triangles.size(), 300U) << "so many it takes";
  EXPECT_LT(light->model.mesh.triangles.size(), model.mesh.triangles.size());
}

TEST(LevelOfDetail, AModelThatIsLightAlreadyStays) {
  const FaceModel model = ball();
  DetailOptions options;
  options.triangles = 1'000'000;
  const auto light = lighten(model, options, std::pmr::get_default_resource());
  ASSERT_TRUE(light);
  EXPECT_TRUE(light->model.mesh.triangles == model.mesh.triangles);
  EXPECT_EQ(light->max_error_mm, 0);
}

TEST(LevelOfDetail, WhatDoesNotHangTogetherIsRefused) {
  FaceModel model = ball();
  model.texture.uv.pop_back();
  EXPECT_FALSE(lighten(model, {}, std::pmr::get_default_resource()));
  DetailOptions options;
  options.triangles = 1;
  EXPECT_FALSE(lighten(ball(), options, std::pmr::get_default_resource()));
}

// Every point against every triangle.
TEST(SurfaceDistance, IsTheNearestOfAll) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> at(-40, 40);
  std::vector<Vec3f> vertices, points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Vec3f middle{at(random), at(random), 300 + at(random)};
    for (int k = 0; k < 3; ++k)
      vertices.push_back({middle.x + at(random) / 8, middle.y + at(random) / 8, middle.z + at(random) / 8});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  for (int i = 0; i < 300; ++i) {
    const Vec3f p{1.5F * at(random), at(random), 300 + at(random)};
    double nearest = 1e30;
    for (const auto& t : triangles)
      nearest =
          std::min(nearest, squared_distance_to_triangle(p, vertices[t[0]], vertices[t[1]], vertices[t[2]]));
    const std::array<Vec3f, 1> one{p};
    EXPECT_NEAR(distance_to_surface(one, vertices, triangles, std::pmr::get_default_resource()).max_mm,
                std::sqrt(nearest), 1e-4);
  }
}

// By hand: above the middle, beside an edge, beyond a corner.
TEST(SurfaceDistance, OfATriangle) {
  const Vec3f a{0, 0, 100}, b{4, 0, 100}, c{0, 4, 100};
  EXPECT_NEAR(squared_distance_to_triangle({1, 1, 103}, a, b, c), 9, 1e-5);
  EXPECT_NEAR(squared_distance_to_triangle({2, -3, 104}, a, b, c), 25, 1e-5);
  EXPECT_NEAR(squared_distance_to_triangle({-3, -4, 100}, a, b, c), 25, 1e-5);
  EXPECT_NEAR(squared_distance_to_triangle({4, 4, 100}, a, b, c), 8, 1e-5);
}

}  // namespace
}  // namespace relievo::pipeline
