// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What two photographs must do together, on a painted plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/texture/texturers.h"
#include "tests/pipeline/texture/painted_plane.h"

namespace relievo::pipeline {
namespace {

using namespace test;  // NOLINT: the painted plane and its numbers

// Crumbs of completed surface, each smaller than a texel of its chart, on a painted surface: they take its
// colour.
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

// More texels than the photograph has pixels, as far as the atlas goes: the same picture, larger.
TEST(TwoViewTexturer, AFinerAtlasShowsTheSameLarger) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  const RectifiedPair pair = photographed_plane();
  TwoViewTexturer twice, capped;
  twice.finer = 2;
  capped.finer = 4, capped.max_atlas_px = 300;
  const auto one = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, pair, c); });
  const auto two = room.run([&](StageContext& c) { return TwoViewTexturer(twice).texture(mesh, pair, c); });
  const auto few = room.run([&](StageContext& c) { return TwoViewTexturer(capped).texture(mesh, pair, c); });
  ASSERT_TRUE(one && two && few);
  EXPECT_NEAR(two->width_px - 16, 2 * (one->width_px - 16), 4);
  EXPECT_NEAR(two->height_px - 16, 2 * (one->height_px - 16), 4);
  EXPECT_LE(std::max(few->width_px, few->height_px), 300);
  double off = 0;
  for (std::size_t c = 0; c < one->uv.size(); ++c)
    off = std::max(off, std::abs(look_up(*one, one->uv[c]).x - look_up(*two, two->uv[c]).x));
  EXPECT_LT(off, 12);
}

// An offset and a gain of its own in each channel of the right view.
TEST(TwoViewTexturer, AnotherWhiteBalanceAndBlackLevelLeaveNoTrace) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  RectifiedPair pair = photographed_plane();
  constexpr double kGain[3] = {0.8, 0.9, 0.7}, kOffset[3] = {12, -8, 20};
  for (std::size_t k = 0; k < pair.right.rgb.size(); ++k)
    pair.right.rgb[k] =
        static_cast<std::uint8_t>(std::lround(kGain[k % 3] * pair.right.rgb[k] + kOffset[k % 3]));
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
    for (int y = 0; y < kPaintedHeight; ++y)
      for (int x = 0; x < kPaintedWidth; ++x) {
        const double dx = camera_x + (x - centre.x) / kFocal * kDepth - at_x;
        const double dy = (y - centre.y) / kFocal * kDepth;
        const double light = 70 * std::exp(-(dx * dx + dy * dy) / (2 * 5.0 * 5.0));
        std::uint8_t* p = &view.rgb[3 * static_cast<std::size_t>(y * kPaintedWidth + x)];
        for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(std::min(255.0, p[c] + light));
      }
  };
  RectifiedPair pair = photographed_plane();
  shine(pair.left, pair.left_centre_px, 0, -20);  // in the left view alone
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

// A dark bar, as a mouth is, that stood 4 mm lower when the right picture was taken: shown once, as one
// camera saw it.
TEST(TwoViewTexturer, WhatMovedBetweenThePicturesIsShownOnce) {
  const FaceMesh mesh = plane_mesh();
  const auto in_bar = [](double x, double y, double middle) {
    return std::abs(x) < 22 && std::abs(y - middle) < 2;
  };
  const auto draw = [&](RectifiedView& view, const Vec2d& centre, double camera_x, double middle) {
    for (int y = 0; y < kPaintedHeight; ++y)
      for (int x = 0; x < kPaintedWidth; ++x) {
        const double at_x = camera_x + (x - centre.x) / kFocal * kDepth;
        const double at_y = (y - centre.y) / kFocal * kDepth;
        if (in_bar(at_x, at_y, middle))
          std::fill_n(&view.rgb[3 * static_cast<std::size_t>(y * kPaintedWidth + x)], 3, std::uint8_t{20});
      }
  };
  RectifiedPair pair = photographed_plane();
  draw(pair.left, pair.left_centre_px, 0, 0);
  draw(pair.right, pair.right_centre_px, kBaseline, 4);
  StageRoom room;
  const auto atlas = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, pair, c); });
  ASSERT_TRUE(atlas);
  std::array<double, 2> worst{0, 0};  // against what the left and the right camera saw
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3f& p = mesh.vertices_mm[v];
    for (std::size_t view = 0; view < 2; ++view) {
      const double middle = 4.0 * static_cast<double>(view);
      if (std::abs(p.x) > 15 || std::abs(p.y) > 10 || std::abs(std::abs(double(p.y) - middle) - 2) < 1)
        continue;  // not the bar's edge
      const double truth = in_bar(double(p.x), double(p.y), middle) ? 20 : paint(double(p.x), double(p.y)).y;
      worst[view] = std::max(worst[view], std::abs(double(atlas->vertex_rgb[3 * v + 1]) - truth));
    }
  }
  EXPECT_LT(std::min(worst[0], worst[1]), 20);
  EXPECT_GT(std::max(worst[0], worst[1]), 50);
}

TEST(TwoViewTexturer, AnUnderexposedRightViewLeavesNoTrace) {
  StageRoom room;
  const FaceMesh mesh = plane_mesh();
  const auto atlas = room.run(
      [&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, photographed_plane(0.7), c); });
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
  EXPECT_TRUE(check_options(TwoViewTexturer{}, "two-view"));
  EXPECT_TRUE(check_options(SingleViewTexturer{}, "single-view"));
  TwoViewTexturer two;
  two.angle_power = -1;
  EXPECT_FALSE(check_options(two, "two-view"));
  SingleViewTexturer one;
  one.margin_px = 1000;
  EXPECT_FALSE(check_options(one, "single-view"));
}

// A strip that was completed, up to the border on the left; the left view grazes it and shows hair there, as
// dark as the brow beside it. The right view shows skin.
TEST(TwoViewTexturer, AViewThatLooksPastACompletedRimIsNotItsPhotograph) {
  constexpr double kStripMm = -105, kBrowMm = 10;
  constexpr std::array<std::uint8_t, 3> kSkin{150, 110, 90};
  RectifiedPair pair = photographed_plane();
  const auto shoot = [&](RectifiedView& view, const Vec2d& centre, double camera_x, bool hair) {
    for (int y = 0; y < kPaintedHeight; ++y)
      for (int x = 0; x < kPaintedWidth; ++x) {
        const double at_x = camera_x + (x - centre.x) / kFocal * kDepth,
                     at_y = (y - centre.y) / kFocal * kDepth;
        const bool dark = (at_x < -40 && std::abs(at_y) < kBrowMm) || (hair && at_x < kStripMm);
        for (std::size_t c = 0; c < 3; ++c)
          view.rgb[3 * static_cast<std::size_t>(y * kPaintedWidth + x) + c] =
              static_cast<std::uint8_t>(kSkin[c] / (dark ? 2 : 1));
      }
  };
  shoot(pair.left, pair.left_centre_px, 0, true);
  shoot(pair.right, pair.right_centre_px, kBaseline, false);
  FaceMesh mesh = plane_mesh();
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v)
    if (static_cast<double>(mesh.vertices_mm[v].x) < kStripMm) {
      mesh.measured[v] = 0;
      mesh.normals[v] = {0.978F, 0, -0.208F};
    }
  StageRoom room;
  const auto atlas = room.run([&](StageContext& c) { return TwoViewTexturer({}).texture(mesh, pair, c); });
  ASSERT_TRUE(atlas);
  int looked_at = 0;
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const Vec3f& p = mesh.vertices_mm[v];
    if (static_cast<double>(p.x) > kStripMm - 5 || std::abs(static_cast<double>(p.y)) < kBrowMm + 10)
      continue;
    ++looked_at;
    EXPECT_NEAR(atlas->vertex_rgb[3 * v], kSkin[0], 8) << p.x << " " << p.y;
  }
  EXPECT_GT(looked_at, 100);
}

}  // namespace
}  // namespace relievo::pipeline
