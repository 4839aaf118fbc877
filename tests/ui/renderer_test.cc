// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What comes out of the GL, pixel by pixel. Needs EGL and a GLES 3 driver (Mesa's llvmpipe will do).
#include "ui/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/ui/quiet_driver.h"
#include "ui/platform/sdl_display.h"

namespace relievo::ui {
namespace {

constexpr int kW = 200, kH = 120;
constexpr Rect kAll{0, 0, kW, kH};

class RendererTest : public testing::Test {
 protected:
  void SetUp() override {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    auto opened = open_sdl_display({kW, kH});
    ASSERT_TRUE(opened.has_value()) << opened.error().where();
    display = std::move(*opened);
    auto made = Renderer::make();
    ASSERT_TRUE(made.has_value()) << made.error().where();
    renderer = std::move(*made);
    auto target_made = Offscreen::make(kW, kH);
    ASSERT_TRUE(target_made.has_value());
    target = std::move(*target_made);
  }
  void TearDown() override {
    target.reset();
    renderer.reset();
    display.reset();
  }
  Command& add(Mark mark, Rect rect, Colour fill) {
    Command c;
    c.mark = mark;
    c.rect = rect;
    c.clip = kAll;
    c.fill = c.fill_end = fill;
    list.commands.push_back(c);
    return list.commands.back();
  }
  void draw() {
    target->begin();
    renderer->draw(list, atlas, kW, kH);
    renderer->read_back(rgb, kW, kH);
    target->end();
  }
  Colour at(int x, int y) const {
    const std::uint8_t* p = rgb.data() + 3 * (static_cast<std::size_t>(y) * kW + static_cast<std::size_t>(x));
    return {p[0], p[1], p[2], 255};
  }

  const QuietDriver quiet;  // the driver takes memory for good in any call
  std::unique_ptr<Display> display;
  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<Offscreen> target;
  TextAtlas atlas{256};
  DrawList list;
  std::vector<std::uint8_t> rgb = std::vector<std::uint8_t>(std::size_t{3} * kW * kH);
};

TEST_F(RendererTest, AShapeHasRoundCornersAndABorder) {
  add(Mark::Shape, {40, 20, 100, 60}, {200, 30, 40, 255}).radius = 20;
  list.commands.back().border = {10, 220, 30, 255};
  list.commands.back().border_px = 4;
  draw();
  EXPECT_EQ(at(90, 50), (Colour{200, 30, 40, 255}));
  EXPECT_EQ(at(90, 21), (Colour{10, 220, 30, 255})) << "border";
  EXPECT_EQ(at(41, 21), (Colour{0, 0, 0, 255})) << "corner";
  EXPECT_EQ(at(38, 50), (Colour{0, 0, 0, 255})) << "beside";
}

TEST_F(RendererTest, WhatLiesOutsideTheClipIsNotDrawn) {
  add(Mark::Flat, kAll, {50, 60, 70, 255}).clip = {20, 10, 30, 40};
  draw();
  EXPECT_NEAR(at(25, 15).g, 60, 1);
  EXPECT_EQ(at(19, 15), (Colour{0, 0, 0, 255}));
  EXPECT_EQ(at(25, 51), (Colour{0, 0, 0, 255}));
  EXPECT_EQ(at(51, 15), (Colour{0, 0, 0, 255}));
}

TEST_F(RendererTest, APictureMayBeMirroredAndIsForgotten) {
  const std::byte two[] = {std::byte{255}, std::byte{0}, std::byte{0},
                           std::byte{0},   std::byte{0}, std::byte{255}};
  list.pictures[static_cast<std::size_t>(PictureSlot::Live)] = {{two, 2, 1, 6, PixelFormat::Rgb8}, 1};
  add(Mark::Image, kAll, {255, 255, 255, 255}).picture = PictureSlot::Live;
  draw();
  EXPECT_EQ(at(5, 60), (Colour{255, 0, 0, 255}));
  EXPECT_EQ(at(195, 60), (Colour{0, 0, 255, 255}));
  list.commands.back().uv = {1, 0, -1, 1};
  draw();
  EXPECT_EQ(at(5, 60), (Colour{0, 0, 255, 255}));
  renderer->forget();
  list.pictures = {};
  draw();
  EXPECT_EQ(at(5, 60), (Colour{0, 0, 0, 255}));
}

TEST_F(RendererTest, ARingDarkensWhatLiesOutside) {
  add(Mark::Flat, kAll, {200, 200, 200, 255});
  Command& ring = add(Mark::Ring, kAll, {0, 0, 0, 128});
  ring.uv = {50, 50, 0, 0};
  ring.border = {0, 255, 0, 255};
  ring.border_px = 6;
  ring.radius = 3;
  draw();
  EXPECT_NEAR(at(100, 60).r, 200, 1) << "inside";
  EXPECT_NEAR(at(5, 5).r, 100, 2) << "outside";
  EXPECT_EQ(at(100, 13), (Colour{0, 255, 0, 255})) << "the line";
}

TEST_F(RendererTest, AShadowFadesOutwards) {
  add(Mark::Flat, kAll, {255, 255, 255, 255});
  Command& shadow = add(Mark::Shape, {60, 40, 80, 40}, {0, 0, 0, 255});
  shadow.radius = 10;
  shadow.blur_px = 8;
  draw();
  EXPECT_LT(at(100, 60).r, 5);
  EXPECT_GT(at(100, 84).r, at(100, 78).r);
  EXPECT_EQ(at(100, 110).r, 255);
}

TEST_F(RendererTest, LettersComeFromTheAtlas) {
  const auto place = atlas.place(4, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) *atlas.row(place->x + x, place->y + y) = 255;
  add(Mark::Glyph, {10, 10, 4, 4}, {250, 120, 60, 255}).uv = {static_cast<float>(place->x),
                                                              static_cast<float>(place->y), 4, 4};
  draw();
  EXPECT_EQ(at(12, 12), (Colour{250, 120, 60, 255}));
  EXPECT_EQ(at(20, 12), (Colour{0, 0, 0, 255}));
}

// A square of 80 mm before the camera, its middle at a height; the head frame looks back at it.
pipeline::FaceModel square_at(float middle_mm) {
  pipeline::FaceModel model(std::pmr::get_default_resource());
  for (const float x : {-40.0F, 40.0F})
    for (const float y : {-40.0F, 40.0F}) {
      model.mesh.vertices_mm.push_back({x, y + middle_mm, 0});
      model.mesh.normals.push_back({0, 0, 1});
    }
  model.mesh.triangles.push_back({0, 1, 2});
  model.mesh.triangles.push_back({1, 3, 2});
  return model;
}

TEST_F(RendererTest, AModelIsSeenFromTheFront) {
  const pipeline::FaceModel model = square_at(0);
  list.faces[0].model = &model;
  list.faces[0].version = 1;
  add(Mark::Face, {40, 0, 120, 120}, {255, 255, 255, 255});
  draw();
  EXPECT_GT(at(100, 60).r, 60) << "lit";
  EXPECT_EQ(at(45, 10), (Colour{0, 0, 0, 255})) << "nothing beside it";
  list.face_look.yaw_deg = 85;
  draw();
  EXPECT_EQ(at(80, 60), (Colour{0, 0, 0, 255})) << "turned away it is narrow";
}

// Wherever its origin lies: in the middle of the window, or of what is free of it.
TEST_F(RendererTest, AModelStandsInTheMiddleOfWhatIsFree) {
  const auto middle_of_lit = [&] {
    int first = -1, last = -1;
    for (int y = 0; y < 120; ++y) {
      if (at(100, y).r <= 60) continue;
      if (first < 0) first = y;
      last = y;
    }
    EXPECT_GT(last, first + 20);
    return static_cast<float>(first + last) / 2;
  };
  list.faces[0].version = 7;
  for (const float middle_mm : {0.0F, 30.0F, -30.0F}) {
    const pipeline::FaceModel model = square_at(middle_mm);
    list.faces[0].model = &model;
    ++list.faces[0].version;
    list.commands.clear();
    add(Mark::Face, {40, 0, 120, 120}, {255, 255, 255, 255});
    draw();
    EXPECT_NEAR(middle_of_lit(), 59.5F, 1.5F) << middle_mm;
    list.commands.back().share = 2.0F / 3;  // the lower third is covered
    draw();
    EXPECT_NEAR(middle_of_lit(), 39.5F, 1.5F) << middle_mm;
  }
}

// Points, edges, surface, texture and light: each does its own in whatever state the others are; the last two
// where there is a surface, or its edges, to be seen by them.
TEST_F(RendererTest, EverySwitchOfAModelIsItsOwn) {
  pipeline::FaceModel model = square_at(0);
  model.texture.width_px = model.texture.height_px = 1;
  model.texture.rgb.assign({200, 40, 40});
  model.texture.uv.assign(6, {0.5F, 0.5F});
  list.faces[0].model = &model;
  list.faces[0].version = 1;
  add(Mark::Face, {40, 0, 120, 120}, {255, 255, 255, 255});
  const auto shown = [this](unsigned state) {
    FaceLook& look = list.face_look;
    look.points = (state & 1U) != 0;
    look.edges = (state & 2U) != 0;
    look.fill = (state & 4U) != 0;
    look.textured = (state & 8U) != 0;
    look.lit = (state & 16U) != 0;
    draw();
    return rgb;
  };
  for (unsigned state = 0; state < 32; ++state) {
    const std::vector<std::uint8_t> one = shown(state);
    for (unsigned which = 0; which < 5; ++which) {
      const bool seen = which < 3 || (state & 6U) != 0;
      EXPECT_EQ(one != shown(state ^ (1U << which)), seen) << "state " << state << ", switch " << which;
    }
  }
  const std::vector<std::uint8_t> nothing = shown(24);
  EXPECT_TRUE(std::all_of(nothing.begin(), nothing.end(), [&](std::uint8_t v) {
    return v == nothing.front();
  })) << "nothing is switched on that could be seen";
}

}  // namespace
}  // namespace relievo::ui
