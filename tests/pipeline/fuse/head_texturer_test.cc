// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/fuse/head_texturer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/pipeline/mesh/stage_room.h"

namespace relievo::pipeline {
namespace {

constexpr int kPhotoPx = 200;
constexpr std::uint8_t kSkin = 120;
constexpr double kWallMm = 500;
constexpr std::uint32_t kSide = 31;

// A wall of 60 mm, two millimetres a cell, that fills the middle of the photograph. Its vertices begin at the
// left.
FaceMesh wall() {
  FaceMesh mesh(std::pmr::get_default_resource());
  for (std::uint32_t x = 0; x < kSide; ++x)
    for (std::uint32_t y = 0; y < kSide; ++y) {
      mesh.vertices_mm.push_back({2 * float(x) - 30, 2 * float(y) - 30, float(kWallMm)});
      mesh.normals.push_back({0, 0, -1});
      mesh.sigma_mm.push_back(0.1F);
      mesh.measured.push_back(1);
    }
  for (std::uint32_t x = 0; x + 1 < kSide; ++x)
    for (std::uint32_t a = x * kSide; a + 1 < (x + 1) * kSide; ++a) {
      mesh.triangles.push_back({a, a + kSide + 1, a + kSide});
      mesh.triangles.push_back({a, a + 1, a + kSide + 1});
    }
  return mesh;
}

struct Texels {
  int dark = 0, filled = 0, photographed = 0;
};

// Of a wall whose photograph has that grey in its right third, and whose columns from that one on close a
// hole. With a `pose` the photograph is not the master's.
Texels texels_of(std::uint8_t right_third, std::uint32_t closing = kSide, const HeadPose* pose = nullptr) {
  std::vector<std::uint8_t> rgb(std::size_t(3 * kPhotoPx * kPhotoPx), kSkin);
  for (std::size_t k = 0; k < rgb.size(); ++k)
    if (k / 3 % kPhotoPx > kPhotoPx * 2 / 3) rgb[k] = right_third;
  HeadView view;
  view.rgb = rgb;
  view.width_px = view.height_px = kPhotoPx;
  view.focal_px = 1500;
  view.centre_px = {kPhotoPx / 2.0, kPhotoPx / 2.0};
  view.master = pose == nullptr;
  view.pose = pose;
  StageRoom room;
  Texels texels;
  const auto done = room.run([&](StageContext& c) -> Result<void> {
    RELIEVO_TRY_ASSIGN(const TextureAtlas atlas,
                       texture_head(wall(), std::size_t{closing} * kSide, std::span(&view, 1), 1024, c));
    for (std::size_t k = 0; k < atlas.origin.size(); ++k) {
      if (atlas.origin[k] == kNoSurfaceTexel) continue;
      ++(atlas.origin[k] == kFilledTexel ? texels.filled : texels.photographed);
      texels.dark += atlas.rgb[3 * k] < kSkin - 10;
    }
    return {};
  });
  EXPECT_TRUE(done);
  return texels;
}

// The crown of a head that reached out of its picture was black.
TEST(HeadTexture, EndsWhereTheRectifiedPhotographDoes) {
  const Texels texels = texels_of(0);
  EXPECT_EQ(texels.dark, 0);
  EXPECT_GT(texels.filled, 100);
}

TEST(HeadTexture, ShowsWhatIsBlackInThePhotograph) {
  const Texels texels = texels_of(1);
  EXPECT_EQ(texels.filled, 0);
  EXPECT_GT(texels.dark, texels.photographed / 4);
}

// Between an ear and the head, what lies behind was painted on the closed hole.
TEST(HeadTexture, OnAClosedHoleIsThatOfTheSkinAround) {
  const Texels texels = texels_of(1, kSide * 2 / 3 - 2);
  EXPECT_EQ(texels.dark, 0);
  EXPECT_GT(texels.filled, 100);
  EXPECT_GT(texels.photographed, texels.filled);
}

// What a pose measured of the wall: all, but for those columns.
HeadPose measured_but(std::uint32_t first, std::uint32_t last) {
  HeadPose pose(std::pmr::get_default_resource());
  pose.columns = pose.rows = int(kSide);
  pose.focal_px = 1500;
  pose.centre_px = {kPhotoPx / 2.0, kPhotoPx / 2.0};
  pose.step_px = 2 * pose.focal_px / kWallMm;
  pose.first_px = {pose.centre_px.x - 15 * pose.step_px, pose.centre_px.y - 15 * pose.step_px};
  for (std::uint32_t row = 0; row < kSide; ++row)
    for (std::uint32_t column = 0; column < kSide; ++column)
      pose.nodes.push_back({{2 * float(column) - 30, 2 * float(row) - 30, float(kWallMm)},
                            {0, 0, -1},
                            0.1F,
                            column >= first && column < last ? 0.0F : 1.0F});
  return pose;
}

// Under a chin, a surface that was a little too large had the colour of the wall behind the person.
TEST(HeadTexture, EndsWhereAPosesOwnMeasureDoesAndNotInItsGaps) {
  const HeadPose right_missing = measured_but(kSide * 2 / 3 - 2, kSide);
  const Texels beyond = texels_of(1, kSide, &right_missing);
  EXPECT_EQ(beyond.dark, 0);
  EXPECT_GT(beyond.filled, 100);
  const HeadPose gap = measured_but(kSide / 3, kSide / 3 + 4);
  const Texels within = texels_of(1, kSide, &gap);
  EXPECT_LT(within.filled, within.photographed / 10);
}

// Nothing of what grows with the photograph lies on the heap, where no plan holds it.
TEST(HeadTexture, TakesItsMemoryFromTheStage) {
  constexpr int kLargePx = 4000;
  constexpr std::size_t kDepthMapBytes = sizeof(float) * kLargePx / 2 * kLargePx / 2;
  const std::vector<std::uint8_t> rgb(std::size_t{3} * kLargePx * kLargePx, kSkin);
  HeadView view;
  view.rgb = rgb;
  view.width_px = view.height_px = kLargePx;
  view.focal_px = 1500;
  view.centre_px = {kLargePx / 2.0, kLargePx / 2.0};
  view.master = true;
  const FaceMesh mesh = wall();
  const std::vector<HeadView> views(5, view);
  const auto texture = [&](StageRoom& room, std::size_t count) {
    return room.run([&](StageContext& c) -> Result<void> {
      RELIEVO_TRY(texture_head(mesh, mesh.vertices_mm.size(), std::span(views).first(count), 256, c));
      return {};
    });
  };
  StageRoom room, little(std::size_t{64} << 20, kDepthMapBytes / 2);
  ASSERT_TRUE(texture(room, 1));
  EXPECT_GE(room.scratch.high_water(), kDepthMapBytes);
  ASSERT_TRUE(texture(room, views.size()));
  EXPECT_LT(room.scratch.high_water(), kDepthMapBytes * (std::size_t(room.pool.size()) + 1))
      << "more views than threads take no more";
  const auto refused = texture(little, 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::OutOfMemory);
}

}  // namespace
}  // namespace relievo::pipeline
