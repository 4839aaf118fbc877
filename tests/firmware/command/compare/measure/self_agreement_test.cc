// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/comparison.h"

#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/bump_scene.h"
#include "tests/support/stage_fixture.h"

namespace relievo::firmware::compare {
namespace {

using pipeline::RectifiedPair;
using test::BumpScene;
using test::StageFixture;

// The scene's own disparities, moved by `off_px`.
DisparityMap truth_of(const BumpScene& scene, const RectifiedPair& pair, float off_px) {
  DisparityMap map(pair.width_px, pair.height_px);
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x)
      map.values[map.index(x, y)] = static_cast<float>(scene.disparity(x, y)) + off_px;
  return map;
}

TEST(SelfAgreement, TwiceMirroredIsThePairItself) {
  StageFixture fixture;
  const BumpScene scene{.seed = 4};
  const RectifiedPair pair = scene.render(&fixture.output);
  const DisparityMap map = truth_of(scene, pair, 0);
  const RectifiedPair once = mirrored(pair, map);
  const RectifiedPair twice = mirrored(once, map);
  EXPECT_NE(once.left.grey, pair.left.grey);
  EXPECT_EQ(twice.left.grey, pair.left.grey);
  EXPECT_EQ(twice.right.rgb, pair.right.rgb);
  EXPECT_DOUBLE_EQ(once.disparity_px(500), pair.disparity_px(500));
  EXPECT_DOUBLE_EQ(twice.left_centre_px.x, pair.left_centre_px.x);
}

// The refined matcher trusts pixels less where a lamp was taken out: the same ones, seen in a mirror.
TEST(SelfAgreement, WhatSkinMirrorsGoesWithItsPixels) {
  StageFixture fixture;
  const BumpScene scene{.seed = 4};
  RectifiedPair pair = scene.render(&fixture.output);
  pair.left.mirrored.assign(pair.pixels(), 0);
  pair.left.mirrored[pair.index(3, 5)] = 200;
  const RectifiedPair once = mirrored(pair, truth_of(scene, pair, 0));
  EXPECT_TRUE(once.left.mirrored.empty()) << "nobody has looked for them in the right view";
  ASSERT_EQ(once.right.mirrored.size(), pair.pixels());
  EXPECT_EQ(once.right.mirrored[pair.index(pair.width_px - 1 - 3, 5)], 200);
  EXPECT_EQ(once.right.mirrored[pair.index(3, 5)], 0);
}

TEST(SelfAgreement, LeftAndRightAgreeOnATrueMapAndNotOnAWrongOne) {
  StageFixture fixture;
  const BumpScene scene{.contrast = 30, .noise = 1, .seed = 5};
  const RectifiedPair pair = scene.render(&fixture.output);
  const auto figures = [&](float off_px) {
    auto found = left_right_figures(pair, pipeline::AlgorithmSet{}, truth_of(scene, pair, off_px),
                                    std::nullopt, fixture.context);
    EXPECT_TRUE(found) << (found ? "" : found.error().what.view());
    return found ? *found : LeftRightFigures{};
  };
  const LeftRightFigures honest = figures(0);
  EXPECT_GT(static_cast<double>(honest.answered), 0.5 * static_cast<double>(honest.asked));
  EXPECT_LT(honest.median_px, 0.1);
  EXPECT_GT(honest.within_1px, 0.95);
  const LeftRightFigures wrong = figures(1.5F);
  EXPECT_NEAR(wrong.median_px, 1.5, 0.3);
  EXPECT_LT(wrong.within_1px, 0.1);
}

TEST(SelfAgreement, ThePhotographFollowsATrueModelOnly) {
  StageFixture fixture;
  const BumpScene scene{.contrast = 30, .noise = 1, .seed = 6};
  const RectifiedPair pair = scene.render(&fixture.output);
  const PhotoFigures honest = photo_figures(pair, truth_of(scene, pair, 0), fixture.context);
  const PhotoFigures wrong = photo_figures(pair, truth_of(scene, pair, 6), fixture.context);
  EXPECT_GT(honest.asked, 10'000U);
  EXPECT_GT(honest.median, 0.95);
  EXPECT_LT(wrong.median, 0.6);
  EXPECT_LE(honest.p5, honest.median);
}

// A plane at a known depth, drawn as two triangles, and a nearer patch that hides part of it.
TEST(SelfAgreement, TheModelsViewIsItsNearestSurface) {
  StageFixture fixture;
  const BumpScene scene{.seed = 7};
  const RectifiedPair pair = scene.render(&fixture.output);
  pipeline::FaceMesh mesh(&fixture.output);
  const auto square = [&](double half_px, double z_mm) {
    const auto half_mm = static_cast<float>(half_px * z_mm / pair.focal_px);
    const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    for (const auto& [x, y] :
         {std::pair{-half_mm, -half_mm}, {half_mm, -half_mm}, {half_mm, half_mm}, {-half_mm, half_mm}})
      mesh.vertices_mm.push_back({x, y, static_cast<float>(z_mm)});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  square(60, 600);
  square(15, 550);
  const DisparityMap map = model_view(pair, mesh);
  const int x = static_cast<int>(pair.left_centre_px.x);
  const int y = static_cast<int>(pair.left_centre_px.y);
  ASSERT_TRUE(map.known(x, y));
  EXPECT_NEAR(static_cast<double>(map.at(x, y)), pair.disparity_px(550), 1e-3);
  ASSERT_TRUE(map.known(x + 30, y));
  EXPECT_NEAR(static_cast<double>(map.at(x + 30, y)), pair.disparity_px(600), 1e-3);
  EXPECT_FALSE(map.known(x, y + 70));
}

}  // namespace
}  // namespace relievo::firmware::compare
