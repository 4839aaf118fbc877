// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/recognition/recognition_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::heap;

// A flat model in the plane z = -30 of the head, 120 mm wide and 160 mm high, whose texture has the
// place painted into it: red grows with x, green with y. The camera stood anywhere.
FaceModel painted_card() {
  FaceModel model(heap());
  constexpr int kSide = 61;
  model.head_from_camera.rotation = {{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  model.head_from_camera.translation_mm = {12, 34, 570};
  const RigidTransform camera_from_head = inverse(model.head_from_camera);
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const Vec3d p = apply(camera_from_head, Vec3d{-60 + 2.0 * i, -80 + 160.0 / 60 * j, -30});
      model.mesh.vertices_mm.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      model.mesh.measured.push_back(j < 55 ? 1 : 0);
    }
  const auto corner = [&](std::uint32_t i, std::uint32_t j) {
    model.texture.uv.push_back(
        {(static_cast<float>(i) * 4 + 0.5F) / 241, (static_cast<float>(j) * 4 + 0.5F) / 241});
    return j * kSide + i;
  };
  for (std::uint32_t j = 0; j + 1 < kSide; ++j)
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      model.mesh.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i, j + 1)});
      model.mesh.triangles.push_back({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  model.texture.width_px = model.texture.height_px = 241;
  for (int y = 0; y < 241; ++y)
    for (int x = 0; x < 241; ++x) {
      model.texture.rgb.insert(model.texture.rgb.end(),
                               {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), 77});
      model.texture.origin.push_back(kLeftPhotographTexel);
    }
  return model;
}

TEST(Portrait, ObeysTheGeometryOfAPassportPhotograph) {
  const FaceModel model = painted_card();
  const Portrait p = draw_portrait(model, heap(), heap());
  const double a = p.width_px, b = p.height_px;
  EXPECT_GE(a / b, 0.74);
  EXPECT_LE(a / b, 0.80);
  EXPECT_GE(p.eyes_px.x / a, 0.45);
  EXPECT_LE(p.eyes_px.x / a, 0.55);
  EXPECT_GE(p.eyes_px.y / b, 0.30);
  EXPECT_LE(p.eyes_px.y / b, 0.50);
  EXPECT_GE(p.camera_mm, 700);
  EXPECT_LE(p.camera_mm, 4000);
  for (const double between_eyes_mm : {50.0, 62.0, 75.0}) EXPECT_GE(between_eyes_mm / p.mm_per_px, 90);
  for (const double head_width_mm : {135.0, 150.0, 170.0}) {
    EXPECT_GE(head_width_mm / p.mm_per_px / a, 0.50);
    EXPECT_LE(head_width_mm / p.mm_per_px / a, 0.75);
  }
  for (const double head_height_mm : {200.0, 225.0, 260.0}) {
    EXPECT_GE(head_height_mm / p.mm_per_px / b, 0.60);
    EXPECT_LE(head_height_mm / p.mm_per_px / b, 0.90);
  }
}

TEST(Portrait, EveryPlaceOfTheHeadFallsWhereAPinholeCameraSeesIt) {
  const Portrait p = draw_portrait(painted_card(), heap(), heap());
  std::size_t seen = 0;
  for (int row = 0; row < p.height_px; row += 7)
    for (int column = 0; column < p.width_px; column += 7) {
      const auto k = static_cast<std::size_t>(row * p.width_px + column);
      // By hand: similar triangles from a camera 1500 mm before the eyes.
      const double z_from_camera = p.camera_mm + p.eyes_mm.z + 30;
      const double mm = p.mm_per_px * z_from_camera / p.camera_mm;
      const double x = p.eyes_mm.x + (column - p.eyes_px.x) * mm, y = p.eyes_mm.y - (row - p.eyes_px.y) * mm;
      if (std::abs(x) > 61 || std::abs(y) > 81) {
        EXPECT_EQ(p.shows[k], kNothingShown);
        EXPECT_EQ(p.rgb[3 * k], 200);
      }
      if (std::abs(x) > 59 || std::abs(y) > 79) continue;
      ++seen;
      ASSERT_NEAR(p.rgb[3 * k], (x + 60) * 2, 1.2) << "the person's left is the picture's right";
      ASSERT_NEAR(p.rgb[3 * k + 1], (y + 80) * 1.5, 1.2) << "up is up";
      if (std::abs(y - 64) > 4) {
        EXPECT_EQ(p.shows[k], y < 64 ? kMeasuredShown : kCompletedShown) << y;
      }
    }
  EXPECT_GT(seen, 3000u);
}

// Every other row of texels is filled, then every other column: a pixel is what the texel nearest to its
// middle is.
TEST(Portrait, WhatWasFilledIsMarkedWhereItIsDrawn) {
  for (const bool rows : {true, false}) {
    FaceModel model = painted_card();
    for (std::size_t k = 0; k < model.texture.origin.size(); ++k)
      model.texture.origin[k] = (rows ? k / 241 : k % 241) % 2 == 1 ? kFilledTexel : kLeftPhotographTexel;
    const Portrait p = draw_portrait(model, heap(), heap());
    const double mm = p.mm_per_px * (p.camera_mm + p.eyes_mm.z + 30) / p.camera_mm;
    const int middle = int(std::lround(p.eyes_px.y + p.eyes_mm.y / mm));  // y = 0: measured
    int seen = 0;
    for (int i = 0; i < (rows ? p.height_px : p.width_px); ++i) {
      const double texel = rows ? (p.eyes_mm.y - (i - p.eyes_px.y) * mm + 80) * 1.5
                                : (p.eyes_mm.x + (i - p.eyes_px.x) * mm + 60) * 2;
      const auto nearest = std::lround(texel);
      if (texel < 2 || texel > (rows ? 200 : 238) ||
          std::abs(texel - static_cast<double>(nearest)) > (rows ? 0.3 : 0.25))
        continue;
      ++seen;
      EXPECT_EQ(
          p.shows[static_cast<std::size_t>(rows ? i * p.width_px + p.width_px / 2 : middle * p.width_px + i)],
          nearest % 2 == 1 ? kCompletedShown : kMeasuredShown)
          << (rows ? "row " : "column ") << texel;
    }
    EXPECT_GT(seen, 100);
  }
}

// Eyes somewhere, not level: their middle is where the standard wants it, and each is where it is drawn.
TEST(Portrait, IsLaidOutByTheEyesWhereTheyWereFound) {
  FaceModel model = painted_card();
  const RigidTransform camera_from_head = inverse(model.head_from_camera);
  const auto put = [&](LandmarkName name, double x, double y, double z) {
    const Vec3d p = apply(camera_from_head, Vec3d{x, y, z});
    Landmark& l = model.landmarks[static_cast<std::size_t>(name)];
    l.at_mm = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    l.found = true;
  };
  put(LandmarkName::ExocanthionRight, -45, 29, -30);
  put(LandmarkName::EndocanthionRight, -17, 27, -30);
  EXPECT_NEAR(draw_portrait(model, heap(), heap()).between_eyes_mm, 62, 1e-3)
      << "the left eye is the right one's mirror image";
  model.landmarks[static_cast<std::size_t>(LandmarkName::ExocanthionRight)].found = false;
  EXPECT_EQ(draw_portrait(model, heap(), heap()).between_eyes_mm, 0) << "no outer corner, no eyes";
  put(LandmarkName::ExocanthionRight, -45, 29, -30);
  put(LandmarkName::EndocanthionLeft, 15, 31, -30);
  put(LandmarkName::ExocanthionLeft, 43, 33, -30);
  const Portrait p = draw_portrait(model, heap(), heap());
  EXPECT_NEAR(p.eyes_mm.x, -1, 1e-3);
  EXPECT_NEAR(p.eyes_mm.y, 30, 1e-3);
  EXPECT_NEAR(p.between_eyes_mm, std::hypot(60, 4), 1e-3);
  EXPECT_NEAR(p.eyes_px.x / p.width_px, 0.5, 0.001);
  EXPECT_NEAR(p.eyes_px.y / p.height_px, 0.45, 0.001);
  EXPECT_NEAR(0.5 * (p.right_eye_px.x + p.left_eye_px.x), p.eyes_px.x, 1e-3);
  EXPECT_LT(p.right_eye_px.x, p.left_eye_px.x) << "the person's right is the picture's left";
  const auto painted_at = [&](const Vec2d& at) {
    const auto k = 3 * static_cast<std::size_t>(std::lround(at.y) * p.width_px + std::lround(at.x));
    return Vec2d{p.rgb[k] / 2.0 - 60, p.rgb[k + 1] / 1.5 - 80};
  };
  EXPECT_NEAR(painted_at(p.right_eye_px).x, -31, 0.8);
  EXPECT_NEAR(painted_at(p.right_eye_px).y, 28, 0.8);
  EXPECT_NEAR(painted_at(p.left_eye_px).x, 29, 0.8);
  EXPECT_NEAR(painted_at(p.left_eye_px).y, 32, 0.8);
}

TEST(Portrait, OfNothingIsRefused) {
  const FaceModel empty(heap());
  const auto images = make_recognition_images(empty, *heap(), *heap());
  ASSERT_FALSE(images);
  EXPECT_EQ(images.error().code, Errc::InvalidInput);
}

TEST(Portrait, TooLittleMemoryIsAnError) {
  const FaceModel model = painted_card();
  std::vector<std::byte> roomy_block(std::size_t{64} << 20), small_block(std::size_t{3} << 20);
  Arena roomy(roomy_block), small(small_block);
  for (const bool small_output : {true, false}) {
    roomy.reset();
    small.reset();
    const auto images =
        make_recognition_images(model, small_output ? small : roomy, small_output ? roomy : small);
    ASSERT_FALSE(images);
    EXPECT_EQ(images.error().code, Errc::OutOfMemory);
  }
}

}  // namespace
}  // namespace relievo::pipeline
