// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two points on a sphere and on a plane of known size, projected and touched at several zooms and turns, give
// their distance to 0.1 mm; what is drawn stands where the projection says; the page's ruler says the same.
#include "ui/render/face_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/contrast.h"
#include "tests/support/made_screen.h"
#include "tests/ui/quiet_driver.h"
#include "ui/platform/sdl_display.h"
#include "ui/render/renderer.h"
#include "ui/technician/technician_view.h"

namespace relievo::ui {
namespace {

using pipeline::Vec2f;
using pipeline::Vec3f;

constexpr FaceLook kLooks[] = {{0, 0, 0, 1},      {25, -10, 0, 1},  {-40, 20, 0, 1.7F},
                               {10, 5, 30, 0.8F}, {-20, -15, 0, 3}, {0, 35, 90, 1.2F}};
constexpr float kAspect = 1.4F, kCovered = 0.15F;

// A camera frame that is turned and far away, as a rig's is.
pipeline::RigidTransform head_from_camera() {
  const double c = std::cos(0.4), s = std::sin(0.4);
  pipeline::RigidTransform t;
  const double m[] = {-c, 0, s, 0, -1, 0, s, 0, c};
  std::copy(std::begin(m), std::end(m), t.rotation.m);
  t.translation_mm = {31, -12, -540};
  return t;
}

// A lattice of so many steps each way; `place` gives the model's frame for shares of it.
template <typename Place>
pipeline::FaceModel lattice(int steps, const Place& place) {
  pipeline::FaceModel model(std::pmr::get_default_resource());
  model.head_from_camera = head_from_camera();
  const pipeline::RigidTransform back = inverse(model.head_from_camera);
  for (int r = 0; r <= steps; ++r)
    for (int c = 0; c <= steps; ++c) {
      const Vec3f at = place(static_cast<float>(c) / static_cast<float>(steps),
                             static_cast<float>(r) / static_cast<float>(steps));
      const Dot shift = dot_of({}, {0, 0, 0});
      const auto v = apply(
          back, pipeline::Vec3d{static_cast<double>(at.x - shift.x), static_cast<double>(at.y - shift.y),
                                static_cast<double>(at.z - shift.z)});
      model.mesh.vertices_mm.push_back(
          {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
      model.mesh.normals.push_back({0, 0, -1});
    }
  const auto n = static_cast<std::uint32_t>(steps + 1);
  for (std::uint32_t r = 0; r + 1 < n; ++r)
    for (std::uint32_t c = 0; c + 1 < n; ++c) {
      const std::uint32_t a = r * n + c;
      model.mesh.triangles.push_back({a, a + n, a + 1});
      model.mesh.triangles.push_back({a + 1, a + n, a + n + 1});
    }
  return model;
}

constexpr float kRadius = 60;
Vec3f on_sphere(float east_deg, float north_deg) {
  const float e = radians(east_deg), n = radians(north_deg);
  return {kRadius * std::sin(e) * std::cos(n), kRadius * std::sin(n),
          kRadius * std::cos(e) * std::cos(n) - 40};
}
// Half a ball: 1.3 mm from one vertex to the next.
pipeline::FaceModel sphere() {
  return lattice(140, [](float u, float v) { return on_sphere(-85 + 170 * u, 85 - 170 * v); });
}
pipeline::FaceModel plane() {
  return lattice(10, [](float u, float v) { return Vec3f{-60 + 120 * u, 50 - 100 * v, 12}; });
}

float distance(const Vec3f& a, const Vec3f& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

void touch_both(const pipeline::FaceModel& model, const Vec3f& a, const Vec3f& b) {
  const FaceStand stand = stand_of(model);
  for (const FaceLook& look : kLooks) {
    const FaceProjection projection(stand, look, kAspect, kCovered);
    const auto first = projection.touched(model, projection.seen(a)),
               second = projection.touched(model, projection.seen(b));
    ASSERT_TRUE(first && second) << look.yaw_deg;
    EXPECT_LT(distance(*first, a), 0.05F) << look.yaw_deg;
    EXPECT_NEAR(distance(*first, *second), distance(a, b), 0.1) << look.yaw_deg << ' ' << look.zoom;
  }
}

// Two charts, cut between the columns: each triangle keeps its own places in the texture, and no vertex but
// those on the cut is handed over twice.
TEST(FaceGeometry, CornersAreSharedButAtTheTexturesSeams) {
  constexpr int kSteps = 10;
  pipeline::FaceModel model = plane();
  const auto u_of = [](std::uint32_t v, bool right) {
    return 0.04F * static_cast<float>(v % (kSteps + 1)) + (right ? 0.5F : 0.0F);
  };
  const auto is_right = [](std::size_t triangle) { return triangle / 2 % kSteps >= kSteps / 2; };
  for (std::size_t t = 0; t < model.mesh.triangles.size(); ++t)
    for (const std::uint32_t v : model.mesh.triangles[t])
      model.texture.uv.push_back({u_of(v, is_right(t)), 0.25F});
  const pipeline::SeamSplit split = pipeline::split_at_seams(model.mesh, model.texture.uv);
  const std::vector<Corner> corners = corners_of(model, split);
  EXPECT_EQ(corners.size(), model.mesh.vertices_mm.size() + kSteps + 1);
  ASSERT_EQ(split.triangles.size(), model.mesh.triangles.size());
  for (std::size_t t = 0; t < split.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = model.mesh.triangles[t][k];
      const Corner& corner = corners[split.triangles[t][k]];
      const Dot at = dot_of(model.head_from_camera, model.mesh.vertices_mm[v]);
      EXPECT_FLOAT_EQ(distance({corner.x, corner.y, corner.z}, at), 0) << t << " " << k;
      EXPECT_FLOAT_EQ(corner.u, u_of(v, is_right(t))) << t << " " << k;
    }
}

TEST(FaceProjection, TwoPointsOnASphereHaveTheirDistance) {
  const pipeline::FaceModel model = sphere();
  touch_both(model, on_sphere(-20, 10), on_sphere(25, -15));
  touch_both(model, on_sphere(0, 0), on_sphere(3, 1));
  const float chord = 2 * kRadius * std::sin(radians(20));
  EXPECT_NEAR(distance(on_sphere(-20, 0), on_sphere(20, 0)), chord, 1e-3);
  touch_both(model, on_sphere(-20, 0), on_sphere(20, 0));
}

TEST(FaceProjection, TwoPointsOnAPlaneOfKnownSizeHaveTheirDistance) {
  touch_both(plane(), {-50, 40, 12}, {50, 40, 12});  // 100 mm
  touch_both(plane(), {-30, -40, 12}, {30, 40, 12});
  touch_both(plane(), {0, 0, 12}, {1, 0, 12});
}

TEST(FaceProjection, BesideTheSurfaceNothingIsTouchedAndOfTwoTheNearerIs) {
  const pipeline::FaceModel model = sphere();
  const FaceProjection ahead(stand_of(model), {}, kAspect, 0);
  EXPECT_FALSE(ahead.touched(model, {0.02F, 0.5F}));
  const FaceProjection aside(stand_of(model), {.yaw_deg = 60}, kAspect, 0);
  const auto hit = aside.touched(model, aside.seen(on_sphere(-60, 0)));
  ASSERT_TRUE(hit);
  EXPECT_LT(distance(*hit, on_sphere(-60, 0)), 0.05F);
}

// Ten millimetres beside the point it turns about, by the scale and by the projection.
TEST(FaceProjection, AMillimetreIsAsLongAsTheScaleSays) {
  const FaceStand stand;
  for (const float zoom : {0.8F, 1.0F, 3.0F}) {
    const FaceProjection projection(stand, {.zoom = zoom}, kAspect, 0);
    const Vec2f a = projection.seen({-5, 0, 0}), b = projection.seen({5, 0, 0});
    EXPECT_NEAR((b.x - a.x) * kAspect, 10 * projection.heights_per_mm(), 1e-4);
  }
}

class Drawn : public testing::Test {
 protected:
  static constexpr int kW = 280, kH = 200;
  void SetUp() override {
    setenv("SDL_VIDEODRIVER", "offscreen", 1);
    auto opened = open_sdl_display({kW, kH});
    ASSERT_TRUE(opened.has_value());
    display = std::move(*opened);
    auto made = Renderer::make();
    auto offscreen = Offscreen::make(kW, kH);
    ASSERT_TRUE(made.has_value() && offscreen.has_value());
    renderer = std::move(*made);
    target = std::move(*offscreen);
  }
  void TearDown() override {
    target.reset();
    renderer.reset();
    display.reset();
  }
  void draw(const Face& face, const FaceLook& look) {
    DrawList list;
    list.faces[0] = face;
    list.face_look = look;
    Command c;
    c.mark = Mark::Face;
    c.rect = c.clip = {0, 0, kW, kH};
    c.fill = {255, 255, 255, 255};
    c.share = 1 - kCovered;
    list.commands.push_back(c);
    target->begin();
    renderer->draw(list, atlas, kW, kH);
    renderer->read_back(rgb, kW, kH);
    target->end();
  }
  int at(int x, int y, std::size_t channel) const {
    return rgb[3 * static_cast<std::size_t>(y * kW + x) + channel];
  }

  const QuietDriver quiet;
  std::unique_ptr<Display> display;
  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<Offscreen> target;
  TextAtlas atlas{256};
  std::vector<std::uint8_t> rgb = std::vector<std::uint8_t>(std::size_t{3} * kW * kH);
};

// The middle of what is bright is where the projection puts the middle of a small square.
TEST_F(Drawn, StandsWhereTheProjectionSays) {
  const Vec3f middle{30, 20, 15};
  const pipeline::FaceModel square = lattice(1, [&](float u, float v) {
    return Vec3f{middle.x - 6 + 12 * u, middle.y + 6 - 12 * v, middle.z};
  });
  std::uint32_t version = 0;
  for (FaceLook look : kLooks) {
    look.textured = look.lit = false;
    draw({&square, nullptr, ++version, nullptr}, look);
    double x = 0, y = 0, all = 0;
    for (int v = 0; v < kH; ++v)
      for (int u = 0; u < kW; ++u) {
        const double light = at(u, v, 0);
        x += light * (u + 0.5), y += light * (v + 0.5), all += light;
      }
    ASSERT_GT(all, 0);
    const Vec2f seen =
        FaceProjection(stand_of(square), look, static_cast<float>(kW) / kH, kCovered).seen(middle);
    EXPECT_NEAR(x / all, static_cast<double>(seen.x) * kW, 0.5) << look.yaw_deg;
    EXPECT_NEAR(y / all, static_cast<double>(seen.y) * kH, 0.5) << look.yaw_deg;
  }
}

// The left half of a plane in red, the right half in blue, as a difference is.
TEST_F(Drawn, HasOtherColoursInPlaceOfItsTextureWhereTheyAreGiven) {
  const pipeline::FaceModel model = plane();
  pipeline::TextureAtlas colours(std::pmr::get_default_resource());
  colours.width_px = 2, colours.height_px = 1;
  colours.rgb = {255, 0, 0, 0, 0, 255};
  for (std::size_t i = 0; i < model.mesh.triangles.size(); ++i)
    colours.uv.insert(colours.uv.end(), 3, Vec2f{(i / 2) % 10 < 5 ? 0.25F : 0.75F, 0.5F});
  draw({&model, nullptr, 1, &colours}, {});
  const Vec2f
      left = FaceProjection(stand_of(model), {}, static_cast<float>(kW) / kH, kCovered).seen({-30, 0, 12}),
      right = FaceProjection(stand_of(model), {}, static_cast<float>(kW) / kH, kCovered).seen({30, 0, 12});
  const auto reds = [&](const Vec2f& p) {
    const int x = static_cast<int>(p.x * kW), y = static_cast<int>(p.y * kH);
    return at(x, y, 0) - at(x, y, 2);
  };
  EXPECT_GT(reds(left), 60);
  EXPECT_LT(reds(right), -60);
  draw({&model, nullptr, 2, nullptr}, {});
  EXPECT_LT(std::abs(reds(left) - reds(right)), 10) << "without them it is of one colour";
}

// Through the page: two taps, and what it says; a finger that moves turns and sets nothing.
TEST(FaceRuler, TwoTapsOnThePageSayTheirDistance) {
  const auto made = test::make_screen();
  Ui& ui = *made;
  const pipeline::FaceModel model = sphere();
  TechnicianView technician;
  technician.phase = TechnicianPhase::Ready;
  technician.result.there = true;
  technician.model = &model;
  technician.model_number = 1;
  ServiceView staff;
  staff.role = StaffRole::Technician;
  staff.technician = &technician;
  ViewState view;
  view.screen = Screen::Staff;
  view.service = &staff;
  Service service;
  service.show(StaffPage::Model);
  ui.show(view, {}, service);
  const auto tap = [&](float x, float y) {
    ui.feed({Input::Kind::Down, 1, x, y}, view);
    ui.feed({Input::Kind::Up, 1, x, y}, view);
    ui.show(view, ui.visit(), ui.service());
  };
  const auto middle = [&](const char* id) {
    const Rect r = ui.tree().find(id)->rect;
    tap(r.x + r.w / 2, r.y + r.h / 2);
  };
  ASSERT_NE(ui.tree().find("scale"), nullptr);
  EXPECT_EQ(ui.tree().find("distance"), nullptr);
  middle("measure");
  ui.visit().look.yaw_deg = 20, ui.visit().look.zoom = 1.5F;
  ui.show(view, ui.visit(), ui.service());
  const Vec3f ends[] = {on_sphere(-20, 5), on_sphere(15, -10)};
  for (const Vec3f& end : ends) {
    const Node& face = *ui.tree().find("face");
    const Vec2f at = FaceProjection(stand_of(model), ui.draw_list().face_look, face.rect.w / face.rect.h,
                                    face.covered_px / face.rect.h)
                         .seen(end);
    tap(face.rect.x + at.x * face.rect.w, face.rect.y + at.y * face.rect.h);
  }
  ASSERT_EQ(ui.service().ruler.count, 2U);
  EXPECT_NEAR(ui.service().ruler.distance_mm(), distance(ends[0], ends[1]), 0.1);
  char mm[16];
  std::snprintf(mm, sizeof mm, "%.1f", static_cast<double>(ui.service().ruler.distance_mm()));
  EXPECT_NE(std::string(ui.tree().find("distance")->text).find(mm), std::string::npos);
  // The words can be read where they come to lie on a white face.
  const Node& words = *ui.tree().find("distance");
  const Node& ground = ui.tree().nodes()[std::size_t(words.parent)];
  const auto under = static_cast<std::uint8_t>(255 - ground.box.fill.a);
  EXPECT_GE(contrast(words.colour, {under, under, under, 255}), 4.5);
  EXPECT_EQ(ground.box.fill.r + ground.box.fill.g + ground.box.fill.b, 0);
  EXPECT_TRUE(ground.rect.holds(words.rect.x, words.rect.y) &&
              ground.rect.holds(words.rect.right() - 1, words.rect.bottom() - 1));
  EXPECT_LT(ground.rect.w * ground.rect.h,
            0.2F * ui.tree().find("face")->rect.w * ui.tree().find("face")->rect.h);
  // The dots stand where the fingers were, the line between them.
  const Node& face = *ui.tree().find("face");
  int dots = 0;
  for (const Command& c : ui.draw_list().commands)
    if (c.mark == Mark::Shape && c.fill == Colour{255, 170, 40, 255}) {
      ++dots;
      const Vec2f &a = ui.service().ruler.seen[0], &b = ui.service().ruler.seen[1];
      const float x = (c.rect.x + c.rect.w / 2 - face.rect.x) / face.rect.w,
                  y = (c.rect.y + c.rect.h / 2 - face.rect.y) / face.rect.h;
      const float off =
          std::abs((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / std::hypot(b.x - a.x, b.y - a.y);
      EXPECT_LT(off, 0.004F);
    }
  EXPECT_GT(dots, 20);
  const FaceLook before = ui.visit().look;
  const Rect r = face.rect;
  ui.feed({Input::Kind::Down, 1, r.x + r.w / 2, r.y + r.h / 2}, view);
  ui.feed({Input::Kind::Move, 1, r.x + r.w / 2 + 60, r.y + r.h / 2}, view);
  ui.feed({Input::Kind::Up, 1, r.x + r.w / 2 + 60, r.y + r.h / 2}, view);
  EXPECT_NE(ui.visit().look.yaw_deg, before.yaw_deg);
  EXPECT_EQ(ui.service().ruler.count, 2U);
}

}  // namespace
}  // namespace relievo::ui
