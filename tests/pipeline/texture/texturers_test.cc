// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A painted surface photographed by both views, so that the right colour of every vertex is known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "pipeline/mesh/surface_cleaner.h"
#include "pipeline/texture/single_view_texturer.h"
#include "pipeline/texture/two_view_texturer.h"
#include "tests/pipeline/mesh/stage_room.h"

namespace relievo::pipeline {
namespace {

using test::StageRoom;
constexpr int kWidth = 400, kHeight = 300;
constexpr double kFocal = 600, kBaseline = 100, kDepth = 500;

// Paint at a place of the world, 40 to 200 in each channel, smooth over some millimetres.
Vec3d paint(double x, double y) {
  return {120 + 60 * std::sin(x / 9), 110 + 50 * std::cos(y / 7), 130 + 40 * std::sin((x + y) / 11)};
}

// Both cameras look along z; the right one stands 100 mm to the right, its window follows the surface.
RectifiedPair photographed(const std::function<double(double, double)>& depth_on_ray, double right_gain = 1) {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = kWidth;
  pair.height_px = kHeight;
  pair.focal_px = kFocal;
  pair.baseline_mm = kBaseline;
  pair.left_centre_px = {kWidth / 2.0, kHeight / 2.0};
  pair.right_centre_px = {kWidth / 2.0 + kFocal * kBaseline / kDepth, kHeight / 2.0};
  pair.right_from_left.translation_mm = {-kBaseline, 0, 0};
  const auto shoot = [&](RectifiedView& view, const Vec2d& centre, double camera_x, double gain) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double sx = (x - centre.x) / kFocal;
        const double sy = (y - centre.y) / kFocal;
        const double z = depth_on_ray(sx, camera_x);
        const Vec3d colour = paint(camera_x + sx * z, sy * z);
        for (const double c : {colour.x, colour.y, colour.z}) view.rgb.push_back(static_cast<std::uint8_t>(std::lround(gain * c)));
        view.valid.push_back(1);
      }
  };
  shoot(pair.left, pair.left_centre_px, 0, 1);
  shoot(pair.right, pair.right_centre_px, kBaseline, right_gain);
  return pair;
}

RectifiedPair photographed_plane(double right_gain = 1) {
  return photographed([](double, double) { return kDepth; }, right_gain);
}

// A lattice of vertices every 4 px of the left view, a border of 40 px left free.
FaceMesh plane_mesh(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) {
  FaceMesh mesh(memory);
  const int columns = (kWidth - 80) / 4 + 1;
  const int rows = (kHeight - 80) / 4 + 1;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      mesh.vertices_mm.push_back({static_cast<float>((40 + 4 * c - kWidth / 2.0) / kFocal * kDepth),
                                  static_cast<float>((40 + 4 * r - kHeight / 2.0) / kFocal * kDepth), static_cast<float>(kDepth)});
      mesh.normals.push_back({0, 0, -1});
      mesh.sigma_mm.push_back(0.1F);
      mesh.measured.push_back(1);
    }
  const auto at = [&](int c, int r) { return static_cast<std::uint32_t>(r * columns + c); };
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      mesh.triangles.push_back({at(c, r), at(c, r + 1), at(c + 1, r + 1)});
      mesh.triangles.push_back({at(c, r), at(c + 1, r + 1), at(c + 1, r)});
    }
  return mesh;
}

std::unique_ptr<Texturer> make(const std::string& name) {
  if (name == "single-view") return std::make_unique<SingleViewTexturer>(SingleViewTexturerOptions{});
  return std::make_unique<TwoViewTexturer>(TwoViewTexturerOptions{});
}

// What a renderer would show at a corner.
Vec3d look_up(const TextureAtlas& atlas, const Vec2f& uv) {
  const int x = static_cast<int>(std::floor(uv.x * static_cast<float>(atlas.width_px)));
  const int y = static_cast<int>(std::floor(uv.y * static_cast<float>(atlas.height_px)));
  const std::size_t k = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width_px) + static_cast<std::size_t>(x));
  return {double(atlas.rgb[k]), double(atlas.rgb[k + 1]), double(atlas.rgb[k + 2])};
}

class TexturerContract : public testing::TestWithParam<std::string> {
 protected:
  Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair, StageRoom& room) const {
    return room.run([&](StageContext& c) { return make(GetParam())->texture(mesh, pair, c); });
  }
};

TEST_P(TexturerContract, EveryCornerShowsThePaint) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  const auto atlas = texture(mesh, photographed_plane(), room);
  ASSERT_TRUE(atlas);
  ASSERT_EQ(atlas->uv.size(), 3 * mesh.triangles.size());
  ASSERT_EQ(atlas->vertex_rgb.size(), 3 * mesh.vertices_mm.size());
  ASSERT_EQ(atlas->rgb.size(), 3 * static_cast<std::size_t>(atlas->width_px) * static_cast<std::size_t>(atlas->height_px));
  EXPECT_LE(std::max(atlas->width_px, atlas->height_px), 2048);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = atlas->uv[3 * t + k];
      ASSERT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
      const Vec3f& p = mesh.vertices_mm[mesh.triangles[t][k]];
      const Vec3d truth = paint(double(p.x), double(p.y));
      const Vec3d seen = look_up(*atlas, uv);
      EXPECT_NEAR(seen.x, truth.x, 3);
      EXPECT_NEAR(seen.y, truth.y, 3);
      EXPECT_NEAR(seen.z, truth.z, 3);
    }
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v]), paint(double(mesh.vertices_mm[v].x), 0).x, 3);
}

TEST_P(TexturerContract, ASmallAtlasIsObeyed) {
  StageRoom room;
  SingleViewTexturerOptions one;
  one.max_atlas_px = 100;
  TwoViewTexturerOptions two;
  two.max_atlas_px = 100;
  const FaceMesh mesh = plane_mesh();
  const RectifiedPair pair = photographed_plane();
  const auto atlas = room.run([&](StageContext& c) {
    return GetParam() == "single-view" ? SingleViewTexturer(one).texture(mesh, pair, c) : TwoViewTexturer(two).texture(mesh, pair, c);
  });
  ASSERT_TRUE(atlas);
  EXPECT_LE(atlas->width_px, 100);
  EXPECT_LE(atlas->height_px, 100);
  for (const Vec2f& uv : atlas->uv) ASSERT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
}

TEST_P(TexturerContract, NothingOfTheRoomGetsIntoTheAtlas) {
  RectifiedPair pair = photographed_plane();
  for (RectifiedView* view : {&pair.left, &pair.right})
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (x > 20 && x < kWidth - 20 && y > 20 && y < kHeight - 20) continue;
        for (std::size_t i = 0; i < 3; ++i) view->rgb[3 * static_cast<std::size_t>(y * kWidth + x) + i] = 255;
      }
  StageRoom room;
  const auto atlas = texture(plane_mesh(), pair, room);
  ASSERT_TRUE(atlas);
  for (const std::uint8_t byte : atlas->rgb) EXPECT_LT(byte, 230);
}

TEST_P(TexturerContract, WithoutASurfaceOrAPictureThereIsNoTexture) {
  StageRoom room;
  const RectifiedPair pair = photographed_plane();
  const auto no_mesh = texture(FaceMesh(std::pmr::get_default_resource()), pair, room);
  ASSERT_FALSE(no_mesh);
  EXPECT_EQ(no_mesh.error().code, Errc::InvalidInput);
  const auto no_picture = texture(plane_mesh(), RectifiedPair(std::pmr::get_default_resource()), room);
  ASSERT_FALSE(no_picture);
  EXPECT_EQ(no_picture.error().code, Errc::InvalidInput);
}

TEST_P(TexturerContract, AMeshOutsideThePictureDoesNoHarm) {
  StageRoom room;
  FaceMesh mesh = plane_mesh();
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); v += 7) mesh.vertices_mm[v].x += 4000;
  mesh.vertices_mm[5].z = -10;
  mesh.vertices_mm[9] = {};
  EXPECT_TRUE(texture(mesh, photographed_plane(), room));
}

TEST_P(TexturerContract, TinyArenaIsAnError) {
  const FaceMesh mesh = plane_mesh();
  const RectifiedPair pair = photographed_plane();
  StageRoom roomy;
  ASSERT_TRUE(texture(mesh, pair, roomy));
  for (std::size_t step = 0; step < 24; ++step) {
    StageRoom small_output(roomy.output.high_water() * step / 24, roomy.scratch.high_water());
    StageRoom small_scratch(roomy.output.high_water(), roomy.scratch.high_water() * step / 24);
    for (StageRoom* room : {&small_output, &small_scratch}) {
      const auto result = texture(mesh, pair, *room);
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, Errc::OutOfMemory);
    }
  }
}

TEST_P(TexturerContract, CancelledAndSameTwice) {
  const FaceMesh mesh = plane_mesh();
  const RectifiedPair pair = photographed_plane();
  StageRoom first, second;
  const auto a = texture(mesh, pair, first);
  const auto b = texture(mesh, pair, second);
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(a->rgb == b->rgb);
  first.cancelled = true;
  const auto cancelled = texture(mesh, pair, first);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, Errc::Cancelled);
}

INSTANTIATE_TEST_SUITE_P(All, TexturerContract, testing::Values("single-view", "two-view"),
                         [](const auto& test_case) { return test_case.param == "two-view" ? "two" : "single"; });

TEST(TwoViewTexturer, AnUnderexposedRightViewLeavesNoTrace) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  const auto atlas = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, photographed_plane(0.7), c); });
  ASSERT_TRUE(atlas);
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3d truth = paint(double(mesh.vertices_mm[v].x), double(mesh.vertices_mm[v].y));
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v]), truth.x, 5);
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v + 2]), truth.z, 5);
  }
}

// A board 40 mm in front hides part of the plane from the right camera; there only the left one counts.
TEST(TwoViewTexturer, WhatTheRightViewCannotSeeIsTakenFromTheLeft) {
  StageRoom room;
  FaceMesh mesh = plane_mesh();
  // The strip x < -60 mm of the lattice stands 60 mm nearer, along its rays.
  for (Vec3f& v : mesh.vertices_mm)
    if (v.x > 20) v = {v.x * 0.88F, v.y * 0.88F, v.z * 0.88F};
  RectifiedPair pair = photographed([](double sx, double camera_x) {
    const double near = kDepth * 0.88;
    return camera_x + sx * near > 20 * 0.88 + 1e-9 ? near : kDepth;
  });
  const auto atlas = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, pair, c); });
  ASSERT_TRUE(atlas);
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3f& p = mesh.vertices_mm[v];
    if (std::abs(p.x - 18) < 6) continue;  // the edge itself, where a triangle spans the step
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v]), paint(double(p.x), 0).x, 12) << p.x << " " << p.y;
  }
}

TEST(Texturers, OptionsHaveLimits) {
  EXPECT_TRUE(TwoViewTexturerOptions{}.check());
  EXPECT_TRUE(SingleViewTexturerOptions{}.check());
  TwoViewTexturerOptions two;
  two.angle_power = -1;
  EXPECT_FALSE(two.check());
  SingleViewTexturerOptions one;
  one.margin_px = 1000;
  EXPECT_FALSE(one.check());
}

}  // namespace
}  // namespace relievo::pipeline
