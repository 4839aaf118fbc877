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

// A wall of 60 mm, two millimetres a cell, that fills the middle of the photograph.
FaceMesh wall() {
  constexpr std::uint32_t kSide = 31;
  FaceMesh mesh(std::pmr::get_default_resource());
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      mesh.vertices_mm.push_back({2 * float(x) - 30, 2 * float(y) - 30, float(kWallMm)});
      mesh.normals.push_back({0, 0, -1});
      mesh.sigma_mm.push_back(0.1F);
      mesh.measured.push_back(1);
    }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t a = y * kSide; a + 1 < (y + 1) * kSide; ++a) {
      mesh.triangles.push_back({a, a + kSide, a + kSide + 1});
      mesh.triangles.push_back({a, a + kSide + 1, a + 1});
    }
  return mesh;
}

struct Texels {
  int dark = 0, filled = 0, photographed = 0;
};

// Of a wall whose photograph has that grey in its right third.
Texels texels_of(std::uint8_t right_third) {
  std::vector<std::uint8_t> rgb(std::size_t(3 * kPhotoPx * kPhotoPx), kSkin);
  for (std::size_t k = 0; k < rgb.size(); ++k)
    if (k / 3 % kPhotoPx > kPhotoPx * 2 / 3) rgb[k] = right_third;
  HeadView view;
  view.rgb = rgb;
  view.width_px = view.height_px = kPhotoPx;
  view.focal_px = 1500;
  view.centre_px = {kPhotoPx / 2.0, kPhotoPx / 2.0};
  view.master = true;
  StageRoom room;
  Texels texels;
  const auto done = room.run([&](StageContext& c) -> Result<void> {
    RELIEVO_TRY_ASSIGN(const TextureAtlas atlas, texture_head(wall(), std::span(&view, 1), 1024, c));
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

}  // namespace
}  // namespace relievo::pipeline
