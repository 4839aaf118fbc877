// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A painted surface photographed by both views, so that the right colour of every vertex is known.
#include <gtest/gtest.h>

#include <algorithm>
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
  const double x = double(uv.x) * atlas.width_px - 0.5;
  const double y = double(uv.y) * atlas.height_px - 0.5;
  const int u = static_cast<int>(std::floor(x));
  const int v = static_cast<int>(std::floor(y));
  double sum[3] = {0, 0, 0};
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double w = (dx == 0 ? 1 - (x - u) : x - u) * (dy == 0 ? 1 - (y - v) : y - v);
      const auto column = static_cast<std::size_t>(std::clamp(u + dx, 0, atlas.width_px - 1));
      const auto row = static_cast<std::size_t>(std::clamp(v + dy, 0, atlas.height_px - 1));
      for (std::size_t c = 0; c < 3; ++c) sum[c] += w * atlas.rgb[3 * (row * static_cast<std::size_t>(atlas.width_px) + column) + c];
    }
  return {sum[0], sum[1], sum[2]};
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
    const auto b = run_stage(context, [&](StageContext& c) { return make(GetParam())->texture(mesh, pair, c); });
    ASSERT_TRUE(b);
    EXPECT_TRUE(a->rgb == b->rgb && a->origin == b->origin && a->vertex_rgb == b->vertex_rgb) << threads;
  }
}

// A cross is painted on what the mesh says was not measured: it must not be shown.
TEST_P(TexturerContract, NothingInventedIsShownAsPhotograph) {
  FaceMesh mesh = plane_mesh();
  RectifiedPair pair = photographed([](double, double) { return kDepth; });
  const auto inside = [](double x, double y) { return std::abs(x) < 25 && std::abs(y) < 25; };
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
    if (inside(double(mesh.vertices_mm[v].x), double(mesh.vertices_mm[v].y))) mesh.measured[v] = 0;
  const auto smear = [&](RectifiedView& view, const Vec2d& centre, double camera_x) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double at_x = camera_x + (x - centre.x) / kFocal * kDepth;
        const double at_y = (y - centre.y) / kFocal * kDepth;
        if (std::abs(at_x) > 20 || std::abs(at_y) > 20) continue;
        std::uint8_t* p = &view.rgb[3 * static_cast<std::size_t>(y * kWidth + x)];
        p[0] = 255, p[1] = 0, p[2] = 0;
      }
  };
  smear(pair.left, pair.left_centre_px, 0);
  smear(pair.right, pair.right_centre_px, kBaseline);
  StageRoom room;
  const auto atlas = texture(mesh, pair, room);
  ASSERT_TRUE(atlas);
  ASSERT_EQ(atlas->origin.size() * 3, atlas->rgb.size());
  std::size_t filled = 0;
  for (std::size_t k = 0; k < atlas->origin.size(); ++k) {
    EXPECT_GT(atlas->rgb[3 * k + 1], 50) << "the cross is nowhere in the atlas";
    filled += atlas->origin[k] == kFilledTexel ? 1 : 0;
  }
  EXPECT_GT(filled, 3000u);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec2f* uv = &atlas->uv[3 * t];
    const int x = static_cast<int>((uv[0].x + uv[1].x + uv[2].x) / 3 * static_cast<float>(atlas->width_px));
    const int y = static_cast<int>((uv[0].y + uv[1].y + uv[2].y) / 3 * static_cast<float>(atlas->height_px));
    const std::uint8_t origin = atlas->origin[static_cast<std::size_t>(y * atlas->width_px + x)];
    const auto& v = mesh.triangles[t];
    if (mesh.measured[v[0]] == 0 || mesh.measured[v[1]] == 0 || mesh.measured[v[2]] == 0) EXPECT_EQ(origin, kFilledTexel);
    else EXPECT_GE(origin, kLeftPhotographTexel);
  }
  // Smooth: no neighbour inside differs by more than the paint's own slope at the border allows.
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = t[i], b = t[(i + 1) % 3];
      if (mesh.measured[a] != 0 || mesh.measured[b] != 0) continue;
      EXPECT_LT(std::abs(int{atlas->vertex_rgb[3 * a + 1]} - int{atlas->vertex_rgb[3 * b + 1]}), 30);
    }
}

// A second plane 40 mm behind, seen from its back: no camera measured it, and no texel is shared with the front.
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

INSTANTIATE_TEST_SUITE_P(All, TexturerContract, testing::Values("single-view", "two-view"),
                         [](const auto& test_case) { return test_case.param == "two-view" ? "two" : "single"; });

// An offset and a gain of its own in each channel of the right view.
// Crumbs of completed surface, each smaller than a texel of its chart, on a painted surface: they take its colour.
TEST(TwoViewTexturer, CrumbsTooSmallForATexelHaveTheirColour) {
  FaceMesh mesh = plane_mesh();
  const RectifiedPair pair = photographed_plane();
  const std::size_t front_triangles = mesh.triangles.size();
  for (std::uint32_t k = 0; k < 40; ++k) {  // each hangs on a vertex of the front by an edge of 0.3 mm
    const std::uint32_t at = 400 + 13 * k;
    const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    const Vec3f v = mesh.vertices_mm[at];
    mesh.vertices_mm.push_back({v.x + 0.3F, v.y, v.z + 0.2F});
    mesh.vertices_mm.push_back({v.x, v.y + 0.3F, v.z + 0.2F});
    for (int i = 0; i < 2; ++i) {
      mesh.normals.push_back({0, 0, 1});
      mesh.sigma_mm.push_back(1);
      mesh.measured.push_back(0);
    }
    mesh.triangles.push_back({at, first, first + 1});  // turned away
  }
  StageRoom room;
  const auto atlas = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, pair, c); });
  ASSERT_TRUE(atlas);
  for (std::size_t c = 3 * front_triangles; c < atlas->uv.size(); ++c) {
    const Vec3d seen = look_up(*atlas, atlas->uv[c]);
    const Vec3f& at = mesh.vertices_mm[mesh.triangles[c / 3][0]];
    const Vec3d wanted = paint(double(at.x), double(at.y));
    ASSERT_NEAR(seen.x, wanted.x, 10) << c;
    ASSERT_NEAR(seen.y, wanted.y, 10) << c;
  }
}

TEST(TwoViewTexturer, AnotherWhiteBalanceAndBlackLevelLeaveNoTrace) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  RectifiedPair pair = photographed_plane();
  constexpr double kGain[3] = {0.8, 0.9, 0.7}, kOffset[3] = {12, -8, 20};
  for (std::size_t k = 0; k < pair.right.rgb.size(); ++k)
    pair.right.rgb[k] = static_cast<std::uint8_t>(std::lround(kGain[k % 3] * pair.right.rgb[k] + kOffset[k % 3]));
  const auto atlas = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, pair, c); });
  ASSERT_TRUE(atlas);
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3d truth = paint(double(mesh.vertices_mm[v].x), double(mesh.vertices_mm[v].y));
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v]), truth.x, 4);
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v + 1]), truth.y, 4);
    EXPECT_NEAR(double(atlas->vertex_rgb[3 * v + 2]), truth.z, 4);
  }
}

// White light added to one view alone is no skin; added to both it may be.
TEST(TwoViewTexturer, AHighlightOfOneViewIsRejectedAndOneOfBothIsKept) {
  const FaceMesh mesh = plane_mesh();
  const auto shine = [](RectifiedView& view, const Vec2d& centre, double camera_x, double at_x) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double dx = camera_x + (x - centre.x) / kFocal * kDepth - at_x;
        const double dy = (y - centre.y) / kFocal * kDepth;
        const double light = 70 * std::exp(-(dx * dx + dy * dy) / (2 * 5.0 * 5.0));
        std::uint8_t* p = &view.rgb[3 * static_cast<std::size_t>(y * kWidth + x)];
        for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(std::min(255.0, p[c] + light));
      }
  };
  RectifiedPair pair = photographed_plane();
  shine(pair.left, pair.left_centre_px, 0, -20);   // in the left view alone
  shine(pair.left, pair.left_centre_px, 0, 20);
  shine(pair.right, pair.right_centre_px, kBaseline, 20);
  StageRoom room;
  const auto atlas = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, pair, c); });
  ASSERT_TRUE(atlas);
  double worst_alone = 0, kept = 0;
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3f& p = mesh.vertices_mm[v];
    const double excess = double(atlas->vertex_rgb[3 * v + 1]) - paint(double(p.x), double(p.y)).y;
    if (std::hypot(p.x + 20, p.y) < 15) worst_alone = std::max(worst_alone, excess);
    if (std::hypot(p.x - 20, p.y) < 1.7F) kept = std::max(kept, excess);
  }
  EXPECT_LT(worst_alone, 12) << "half of what the level lets pass";
  EXPECT_GT(kept, 55);
}

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
