// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Seams of a simulated face, photographed by cameras that disagree about its brightness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "pipeline/pipeline.h"
#include "pipeline/texture/texturers.h"
#include "tests/support/colour_difference.h"
#include "tests/support/meshed_pair.h"
#include "tests/support/proof.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"
#include "tests/support/stage_fixture.h"
#include "tests/support/texture_seams.h"

namespace relievo::pipeline {
namespace {

using test::SeamFigures;

// Published pairs of Sharma, Wu and Dalal (2005), table 1: the formula's awkward corners.
TEST(ColourDifference, AgreesWithThePublishedPairs) {
  const struct {
    test::Lab one, two;
    double difference;
  } kPairs[] = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
                {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
                {{50, 0, 0}, {50, -1, 2}, 2.3669},
                {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
                {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
                {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
                {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
                {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};
  for (const auto& pair : kPairs) EXPECT_NEAR(test::ciede2000(pair.one, pair.two), pair.difference, 1e-4);
  const test::Lab white = test::lab_of({255, 255, 255});
  EXPECT_NEAR(white.l, 100, 1e-3);
  EXPECT_NEAR(std::hypot(white.a, white.b), 0, 0.02);
}

// A face whose left half is painted by one photograph and its right half by another, 20 levels brighter.
TEST(TextureSeams, TheMeasureSeesAStep) {
  FaceMesh mesh(std::pmr::get_default_resource());
  TextureAtlas atlas(std::pmr::get_default_resource());
  constexpr int kSide = 41;
  atlas.width_px = atlas.height_px = 200;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      for (int c = 0; c < 3; ++c) atlas.rgb.push_back(x < 100 ? 120 : 140);
      atlas.origin.push_back(x < 100 ? 2 : 255);
    }
  const auto corner = [&](int x, int y) {
    atlas.uv.push_back({static_cast<float>(x) / (kSide - 1), static_cast<float>(y) / (kSide - 1)});
    return static_cast<std::uint32_t>(y * kSide + x);
  };
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      mesh.vertices_mm.push_back({static_cast<float>(x), static_cast<float>(y), 500});
  for (int y = 0; y + 1 < kSide; ++y)
    for (int x = 0; x + 1 < kSide; ++x) {
      mesh.triangles.push_back({corner(x, y), corner(x, y + 1), corner(x + 1, y + 1)});
      mesh.triangles.push_back({corner(x, y), corner(x + 1, y + 1), corner(x + 1, y)});
    }
  const test::SeamReport report = test::measure_seams(mesh, atlas);
  const double truth = test::ciede2000(test::lab_of({120, 120, 120}), test::lab_of({140, 140, 140}));
  EXPECT_EQ(report.step.count, 40u);
  EXPECT_NEAR(report.across.median, truth, 0.2);
  EXPECT_GT(report.step.median, 0.4 * truth) << "the filter between texels softens it";
}

class SeamsOfAFace : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    rig = new hal::sim::SimRig(hal::sim::make_rig(test::small_rig(0.45)));
    ThreadPool pool(2);
    const auto head = hal::sim::make_head(hal::sim::traits_of(3), pool);
    scene = hal::sim::make_head_scene(head, {}, pool).release();
  }
  static void TearDownTestSuite() {
    delete scene;
    delete rig;
  }
  // The right camera gets `right_exposure` times the left one's light.
  test::SeamReport seams(double right_exposure) {
    test::StageFixture fixture;
    hal::sim::SensorOptions left, right;
    right.exposure = right_exposure;
    const auto l = hal::sim::read_sensor(hal::sim::expose(*scene, rig->left, left, fixture.pool), left, 1);
    const auto r = hal::sim::read_sensor(hal::sim::expose(*scene, rig->right, right, fixture.pool), right, 2);
    const auto pipeline = Pipeline::make({}, test::true_calibration(*rig));
    EXPECT_TRUE(pipeline);
    StageContext& c = fixture.context;
    auto meshed = test::mesh_of(*pipeline, {l.view(), r.view(), 0, 0}, c);
    EXPECT_TRUE(meshed);
    RectifiedPair& pair = meshed->pair;
    FaceMesh& mesh = meshed->mesh;
    const auto left_alone = SingleViewTexturer({}).texture(mesh, pair, c);
    EXPECT_TRUE(left_alone);
    auto texture = pipeline->texture(mesh, pair, c);
    EXPECT_TRUE(texture);
    const auto model = pipeline->assemble(std::move(mesh), *std::move(texture), pair, c);
    EXPECT_TRUE(model);
    EXPECT_GT(model->quality.texture_sharpness, 0.3);
    return test::measure_seams(model->mesh, model->texture, &*left_alone);
  }
  static void print(double exposure, const test::SeamReport& r) {
    std::printf(
        "right camera %.2f of the light: %zu seam edges, step %.2f / %.2f, over 3 mm %.2f / %.2f (CIEDE2000, median / 95 %%)\n",
        exposure, r.step.count, r.step.median, r.step.p95, r.across.median, r.across.p95);
  }
  static hal::sim::SimRig* rig;
  static hal::sim::Scene* scene;
};
hal::sim::SimRig* SeamsOfAFace::rig = nullptr;
hal::sim::Scene* SeamsOfAFace::scene = nullptr;

TEST_F(SeamsOfAFace, CannotBeSeenHoweverUnequalTheExposures) {
  RELIEVO_MANY_TRIALS();
  for (const double exposure : {1.0, 0.6}) {
    const test::SeamReport report = seams(exposure);
    print(exposure, report);
    EXPECT_GT(report.step.count, 100u);
    EXPECT_LT(report.step.median, 1.5) << exposure;
    EXPECT_LT(report.step.p95, 4) << exposure;
    EXPECT_LT(report.across.median, 1.5) << exposure;
    EXPECT_LT(report.across.p95, 4) << exposure;
  }
}

// A lamp above the cameras mirrored by oily skin: up to 70 grey levels of its light, where the surface's true
// normal halves the angle between lamp and camera (Blinn, 1977; the lobe is 5 degrees wide).
void mirror_a_lamp(hal::Picture& picture, const hal::sim::Scene& scene, const hal::sim::SimView& view) {
  const hal::sim::Vec3 lamp{150, -420, 40}, eye = view.centre();
  const auto unit = [](const hal::sim::Vec3& v) {
    const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return hal::sim::Vec3{v.x / length, v.y / length, v.z / length};
  };
  for (int y = 0; y < picture.height_px; ++y)
    for (int x = 0; x < picture.width_px; ++x) {
      const hal::sim::Vec3 ray = view.ray(x, y);
      hal::sim::SolidPoint at;
      if (!scene.solid(eye, ray, at)) continue;
      const hal::sim::Vec3 to_lamp = unit({lamp.x - at.point.x, lamp.y - at.point.y, lamp.z - at.point.z});
      const hal::sim::Vec3 half = unit({to_lamp.x - ray.x, to_lamp.y - ray.y, to_lamp.z - ray.z});
      const double cosine = half.x * at.normal.x + half.y * at.normal.y + half.z * at.normal.z;
      const double light = cosine > 0 ? 70 * std::pow(cosine, 300) : 0;
      std::byte* p = &picture.bytes[3 * static_cast<std::size_t>(y * picture.width_px + x)];
      for (int c = 0; c < 3; ++c)
        p[c] = static_cast<std::byte>(std::min(255.0, std::to_integer<int>(p[c]) + light));
    }
}

TEST_F(SeamsOfAFace, ALampMirroredByTheSkinIsNotPaintedOnIt) {
  test::StageFixture fixture;
  StageContext& c = fixture.context;
  auto pictures = hal::sim::render_pair(*scene, *rig, {}, 1, fixture.pool);
  const auto pipeline = Pipeline::make({}, test::true_calibration(*rig));
  ASSERT_TRUE(pipeline);
  const auto meshed = test::mesh_of(*pipeline, {pictures.left.view(), pictures.right.view(), 0, 0}, c);
  ASSERT_TRUE(meshed);
  const auto& [dull, mesh] = *meshed;
  mirror_a_lamp(pictures.left, *scene, rig->left);
  mirror_a_lamp(pictures.right, *scene, rig->right);
  const auto shining = pipeline->rectify({pictures.left.view(), pictures.right.view(), 0, 0}, c);
  ASSERT_TRUE(shining);
  const auto truth = TwoViewTexturer({}).texture(mesh, dull, c);
  const auto one_view = SingleViewTexturer({}).texture(mesh, *shining, c);
  const auto both_views = TwoViewTexturer({}).texture(mesh, *shining, c);
  ASSERT_TRUE(truth && one_view && both_views);
  // How much of the lamp is left on the skin, on the vertices where one photograph alone shows much of it.
  double one = 0, both = 0, count = 0;
  for (std::size_t v = 0; v < mesh.vertices_mm.size(); ++v) {
    const double alone = double(one_view->vertex_rgb[3 * v + 1]) - truth->vertex_rgb[3 * v + 1];
    if (alone < 25) continue;
    one += alone;
    both += double(both_views->vertex_rgb[3 * v + 1]) - truth->vertex_rgb[3 * v + 1];
    count += 1;
  }
  ASSERT_GT(count, 200);
  std::printf(
      "a lamp on the skin, %.0f vertices: one photograph shows %.1f levels of it, both together %.1f\n",
      count, one / count, both / count);
  EXPECT_LT(both / one, 0.4);
}

}  // namespace
}  // namespace relievo::pipeline
