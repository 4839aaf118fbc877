// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every texturer must do, on a painted plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory_resource>
#include <span>
#include <string>

#include "pipeline/texture/blend/shot_planes.h"
#include "pipeline/texture/colour_fill.h"
#include "pipeline/texture/texturers.h"
#include "tests/pipeline/texture/painted_plane.h"
#include "tests/support/names_of.h"

namespace relievo::pipeline {
namespace {

using namespace test;  // NOLINT: the painted plane and its numbers

Texturer make(const std::string& name, const relievo::test::Settings& settings = {}) {
  return relievo::test::made(&Algorithms::texturer, "texturer", name, settings);
}

class TexturerContract : public testing::TestWithParam<std::string> {
 protected:
  Result<TextureAtlas> texture(const FaceMesh& mesh, const RectifiedPair& pair, StageRoom& room) const {
    return room.run([&](StageContext& c) { return make(GetParam())(mesh, pair, c); });
  }
};

// Without an inside it has no colours to go on from but those of its rim: not the mean of all, which shows.
TEST(ContinueOutwards, AThinChartHasAMarginOfItsOwnColour) {
  constexpr int kSide = 64, kMargin = 4, kLeft = 40, kTop = 20, kBottom = 40;
  constexpr std::array<std::uint8_t, 3> kHair{30, 60, 90};
  for (const int wide : {1, 2, 3, 4, 9}) {
    TextureAtlas atlas(std::pmr::get_default_resource());
    atlas.width_px = atlas.height_px = kSide;
    atlas.rgb.assign(3 * kSide * kSide, 200);
    atlas.origin.assign(kSide * kSide, kNoSurfaceTexel);
    const auto cover = [&](int left, int right, std::span<const std::uint8_t> colour) {
      for (int y = kTop; y < kBottom; ++y)
        for (int x = left; x < right; ++x) {
          atlas.origin[atlas.index(x, y)] = kLeftPhotographTexel;
          for (std::size_t c = 0; c < colour.size(); ++c) atlas.rgb[3 * atlas.index(x, y) + c] = colour[c];
        }
    };
    cover(4, 24, {});
    cover(kLeft, kLeft + wide, kHair);
    continue_outwards(atlas, kMargin, std::pmr::get_default_resource());
    for (int y = kTop + kMargin; y < kBottom - kMargin; ++y)
      for (int x = kLeft - kMargin; x < kLeft + wide + kMargin; ++x)
        ASSERT_EQ(atlas.rgb[3 * atlas.index(x, y)], kHair[0]) << wide << " wide: " << x << ", " << y;
  }
}

TEST_P(TexturerContract, EveryCornerShowsThePaint) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  const auto atlas = texture(mesh, photographed_plane(), room);
  ASSERT_TRUE(atlas);
  ASSERT_EQ(atlas->uv.size(), 3 * mesh.triangles.size());
  ASSERT_EQ(atlas->vertex_rgb.size(), 3 * mesh.vertices_mm.size());
  ASSERT_EQ(atlas->rgb.size(),
            3 * static_cast<std::size_t>(atlas->width_px) * static_cast<std::size_t>(atlas->height_px));
  EXPECT_LE(std::max(atlas->width_px, atlas->height_px), 2048);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = atlas->uv[3 * t + k];
      ASSERT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
      const Vec3f& p = mesh.vertices_mm[mesh.triangles[t][k]];
      const Vec3d truth = paint(double(p.x), double(p.y));
      const Vec3d seen = look_up(*atlas, uv);
      // At the outline the filter mixes in texels beyond, whose colours come from two texels inside.
      const double allowed = std::abs(p.x) > 132 || std::abs(p.y) > 90 ? 8 : 3;
      EXPECT_NEAR(seen.x, truth.x, allowed) << p.x << " " << p.y;
      EXPECT_NEAR(seen.y, truth.y, allowed);
      EXPECT_NEAR(seen.z, truth.z, allowed);
    }
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v]), paint(double(mesh.vertices_mm[v].x), 0).x, 3);
}

TEST_P(TexturerContract, ASmallAtlasIsObeyed) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  const RectifiedPair pair = photographed_plane();
  const Texturer small = make(GetParam(), {{GetParam() + ".max_atlas_px", "100"}});
  const auto atlas = room.run([&](StageContext& c) { return small(mesh, pair, c); });
  ASSERT_TRUE(atlas);
  EXPECT_LE(atlas->width_px, 100);
  EXPECT_LE(atlas->height_px, 100);
  for (const Vec2f& uv : atlas->uv) ASSERT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
}

TEST_P(TexturerContract, NothingOfTheRoomGetsIntoTheAtlas) {
  RectifiedPair pair = photographed_plane();
  for (RectifiedView* view : {&pair.left, &pair.right})
    for (int y = 0; y < kPaintedHeight; ++y)
      for (int x = 0; x < kPaintedWidth; ++x) {
        if (x > 20 && x < kPaintedWidth - 20 && y > 20 && y < kPaintedHeight - 20) continue;
        for (std::size_t i = 0; i < 3; ++i)
          view->rgb[3 * static_cast<std::size_t>(y * kPaintedWidth + x) + i] = 255;
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
  for (std::size_t step = 0; step < 12; ++step) {
    StageRoom small_output(roomy.output.high_water() * step / 12, roomy.scratch.high_water());
    StageRoom small_scratch(roomy.output.high_water(), roomy.scratch.high_water() * step / 12);
    for (StageRoom* room : {&small_output, &small_scratch}) {
      const auto result = texture(mesh, pair, *room);
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, Errc::OutOfMemory);
    }
  }
}

TEST_P(TexturerContract, Cancelled) {
  StageRoom room;
  room.cancelled = true;
  const auto cancelled = texture(plane_mesh(), photographed_plane(), room);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, Errc::Cancelled);
}

// As many passes as a surface takes whose triangles lie badly: what changes for ever ends all the same.
TEST(SweepEdges, EndWhenTheStageIsStopped) {
  StageRoom room;
  constexpr std::array<Triangle, 1> kOne{{{0, 1, 2}}};
  int steps = 0;
  sweep_edges(kOne, room.context, [&](std::uint32_t, std::uint32_t) {
    if (++steps == 100) room.cancelled = true;
    return steps < 1000;
  });
  EXPECT_GE(steps, 100);
  EXPECT_LT(steps, 200);
}

TEST_P(TexturerContract, TheSameTwiceAndForAnyNumberOfThreads) {
  const FaceMesh mesh = plane_mesh();
  const RectifiedPair pair = photographed_plane(0.8);
  StageRoom first;
  const auto a = texture(mesh, pair, first);
  ASSERT_TRUE(a);
  for (const int threads : {1, 2, 3}) {
    StageRoom room;
    ThreadPool pool(threads);
    StageContext context{room.output, room.scratch, pool, room.progress, room.cancelled};
    const auto b = run_stage(context, [&](StageContext& c) { return make(GetParam())(mesh, pair, c); });
    ASSERT_TRUE(b);
    EXPECT_TRUE(a->rgb == b->rgb && a->origin == b->origin && a->vertex_rgb == b->vertex_rgb) << threads;
  }
}

// Whether a surface was measured says nothing of whether a camera saw it: a square is painted where the mesh
// was completed.
TEST_P(TexturerContract, WhatWasCompletedShowsThePhotographOfIt) {
  FaceMesh mesh = plane_mesh();
  RectifiedPair pair = photographed([](double, double) { return kDepth; });
  const auto within = [](const Vec3f& v, float mm) { return std::abs(v.x) < mm && std::abs(v.y) < mm; };
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
    if (within(mesh.vertices_mm[v], 25)) mesh.measured[v] = 0;
  const auto paint = [&](RectifiedView& view, const Vec2d& centre, double camera_x) {
    for (int y = 0; y < kPaintedHeight; ++y)
      for (int x = 0; x < kPaintedWidth; ++x) {
        const double at_x = camera_x + (x - centre.x) / kFocal * kDepth;
        const double at_y = (y - centre.y) / kFocal * kDepth;
        if (std::abs(at_x) > 20 || std::abs(at_y) > 20) continue;
        std::uint8_t* p = &view.rgb[3 * static_cast<std::size_t>(y * kPaintedWidth + x)];
        p[0] = 255, p[1] = 0, p[2] = 0;
      }
  };
  paint(pair.left, pair.left_centre_px, 0);
  paint(pair.right, pair.right_centre_px, kBaseline);
  StageRoom room;
  const auto atlas = texture(mesh, pair, room);
  ASSERT_TRUE(atlas);
  std::size_t painted = 0;
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    if (!within(mesh.vertices_mm[v], 18)) continue;
    ++painted;
    EXPECT_GT(atlas->vertex_rgb[3 * v], 240);
    EXPECT_LT(atlas->vertex_rgb[3 * v + 1], 15);
  }
  EXPECT_GT(painted, 50U);
  EXPECT_EQ(std::count(atlas->origin.begin(), atlas->origin.end(), kFilledTexel), 0)
      << "every part of a plane before the cameras is seen";
}

// A second plane 40 mm behind, seen from its back: no camera measured it, and no texel is shared with the
// front.
TEST_P(TexturerContract, WhatTurnsAwayHasTexelsOfItsOwn) {
  FaceMesh mesh = plane_mesh();
  const auto n = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  const std::size_t front_triangles = mesh.triangles.size();
  for (std::uint32_t v = 0; v < n; ++v) {
    Vec3f at = mesh.vertices_mm[v];
    at.z += 40;
    mesh.vertices_mm.push_back(at);
    mesh.normals.push_back({0, 0, 1});
    mesh.sigma_mm.push_back(1);
    mesh.measured.push_back(0);
  }
  for (std::size_t t = 0; t < front_triangles; ++t) {
    const auto front = mesh.triangles[t];
    mesh.triangles.push_back({front[0] + n, front[2] + n, front[1] + n});
  }
  StageRoom room;
  const auto atlas = texture(mesh, photographed_plane(), room);
  ASSERT_TRUE(atlas);
  EXPECT_LE(std::max(atlas->width_px, atlas->height_px), 2048);
  float front_right = 0;
  for (std::size_t c = 0; c < 3 * front_triangles; ++c) front_right = std::max(front_right, atlas->uv[c].x);
  for (std::size_t c = 3 * front_triangles; c < atlas->uv.size(); ++c) {
    const Vec2f uv = atlas->uv[c];
    ASSERT_TRUE(uv.x > front_right && uv.x < 1 && uv.y > 0 && uv.y < 1);
    const int x = static_cast<int>(uv.x * static_cast<float>(atlas->width_px));
    const int y = static_cast<int>(uv.y * static_cast<float>(atlas->height_px));
    EXPECT_LE(atlas->origin[static_cast<std::size_t>(y * atlas->width_px + x)], kFilledTexel);
  }
}

INSTANTIATE_TEST_SUITE_P(All, TexturerContract, testing::ValuesIn(relievo::test::names_of("texturer")),
                         [](const auto& test_case) { return relievo::test::test_name(test_case.param); });

}  // namespace
}  // namespace relievo::pipeline
