// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A showpiece is whole and has an even rim: judged on a flat sheet whose area, texture and outline are known.
#include "firmware/kiosk/showpiece_finish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/mesh/detail/level_of_detail.h"

namespace relievo::firmware {
namespace {

constexpr int kSide = 121;            // vertices a side, 2 mm apart
constexpr float kStep = 2, kHalf = kStep * (kSide - 1) / 2;

// The middle of the sheet is the head frame's origin; its texture lies straight on it.
pipeline::FaceModel sheet(bool holed) {
  pipeline::FaceModel model(std::pmr::get_default_resource());
  model.head_from_camera = {{{1, 0, 0, 0, 1, 0, 0, 0, 1}}, {0, 0, -500}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      model.mesh.vertices_mm.push_back({kStep * static_cast<float>(x) - kHalf, kStep * static_cast<float>(y) - kHalf, 500});
      model.mesh.normals.push_back({0, 0, 1});
      model.mesh.sigma_mm.push_back(0.1F);
      model.mesh.measured.push_back(1);
    }
  const auto corner = [&](int x, int y) { return static_cast<std::uint32_t>(y * kSide + x); };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    model.mesh.triangles.push_back({a, b, c});
    for (const std::uint32_t v : {a, b, c}) {
      const pipeline::Vec3f& p = model.mesh.vertices_mm[v];
      model.texture.uv.push_back({(p.x + kHalf) / (2 * kHalf), (p.y + kHalf) / (2 * kHalf)});
    }
  };
  for (int y = 0; y + 1 < kSide; ++y)
    for (int x = 0; x + 1 < kSide; ++x) {
      if (holed && x >= 50 && x < 53 && y >= 60 && y < 62) continue;   // 6 x 4 mm
      add(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1));
      add(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
    }
  return model;
}

// With its sign: a triangle that was turned round counts against the others.
double area(const pipeline::FaceModel& model) {
  double sum = 0;
  for (const auto& t : model.mesh.triangles) {
    const auto &a = model.mesh.vertices_mm[t[0]], &b = model.mesh.vertices_mm[t[1]], &c = model.mesh.vertices_mm[t[2]];
    sum += 0.5 * static_cast<double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  return sum;
}

TEST(ShowpieceFinish, AHoleIsClosedAndTheRimStaysOpen) {
  pipeline::FaceModel model = sheet(true);
  const double whole = static_cast<double>(4 * kHalf * kHalf);
  EXPECT_NEAR(area(model), whole - 24, 1e-2);
  pipeline::FaceModel kept = model;
  close_holes(kept, 19);   // the hole is 20 mm round
  EXPECT_EQ(kept.mesh.triangles.size(), model.mesh.triangles.size());
  close_holes(model, 21);
  EXPECT_NEAR(area(model), whole, 1e-2);
  EXPECT_EQ(model.mesh.triangles.size(), kept.mesh.triangles.size() + 10);
  EXPECT_EQ(model.mesh.measured.back(), 0) << "nobody measured it";
  EXPECT_EQ(model.texture.uv.size(), 3 * model.mesh.triangles.size());
}

TEST(ShowpieceFinish, WhatIsCutEndsOnTheOvalAndKeepsItsTexture) {
  pipeline::FaceModel model = sheet(false);
  const ShowpieceOval oval{50, 10, 80, 60, 2};
  cut_to_oval(model, oval);
  EXPECT_NEAR(area(model), std::numbers::pi * 50 * (80 + 60) / 2, 12) << "chords of 2 mm";
  double farthest = 0;
  for (std::size_t t = 0; t < model.mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const pipeline::Vec3f& p = model.mesh.vertices_mm[model.mesh.triangles[t][k]];
      const double y = static_cast<double>(p.y) - oval.middle_mm;
      farthest = std::max(farthest, std::hypot(static_cast<double>(p.x) / oval.half_width_mm, y / (y > 0 ? oval.up_mm : oval.down_mm)));
      const pipeline::Vec2f& uv = model.texture.uv[3 * t + k];
      EXPECT_NEAR(uv.x, (p.x + kHalf) / (2 * kHalf), 1e-5F);
      EXPECT_NEAR(uv.y, (p.y + kHalf) / (2 * kHalf), 1e-5F);
    }
  EXPECT_NEAR(farthest, 1, 2e-3);
  EXPECT_EQ(model.mesh.normals.size(), model.mesh.vertices_mm.size());
  for (const pipeline::Vec3f& p : model.mesh.vertices_mm) EXPECT_LT(std::abs(p.x), 51) << "of what was cut off nothing stays";
  EXPECT_TRUE(pipeline::lighten(model, {}, std::pmr::get_default_resource())) << "it hangs together";
}

}  // namespace
}  // namespace relievo::firmware
