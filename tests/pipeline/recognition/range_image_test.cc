// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/statistics.h"
#include "pipeline/recognition/recognition_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "pipeline/pipeline.h"
#include "tests/support/meshed_pair.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::heap;

// Head frame here is the frame of the mesh.
double height(double x, double y) { return -x * x / 150 - y * y / 300 + 8 * std::sin(x / 15); }

// z = height(x, y) + `lift`, on a lattice of 1.3 mm; `turned` looks away.
void add_sheet(FaceMesh& mesh, float lift, bool turned, std::uint8_t measured) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  constexpr int kSide = 81;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double x = (i - 40) * 1.3, y = (j - 40) * 1.3;
      mesh.vertices_mm.push_back(
          {static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y)) + lift});
      mesh.sigma_mm.push_back(0.2F);
      mesh.measured.push_back(measured);
    }
  for (std::uint32_t j = 0; j + 1 < kSide; ++j)
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t a = first + j * kSide + i, b = a + 1, c = a + kSide, d = c + 1;  // y grows upwards
      if (turned) mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
      else mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
    }
}

TEST(RangeImage, HoldsTheHeightsOfTheSurface) {
  FaceMesh mesh(heap());
  add_sheet(mesh, 0, false, 1);
  const RangeImage image = measure_range(mesh, {}, heap(), heap());
  ASSERT_EQ(image.z_mm.size(), 401u * 501u);
  std::size_t shown = 0;
  for (int row = 0; row < image.height_px; ++row)
    for (int column = 0; column < image.width_px; ++column) {
      const auto k = static_cast<std::size_t>(row * image.width_px + column);
      const double x = -100 + 0.5 * column, y = 130 - 0.5 * row;
      const bool inside = std::abs(x) <= 51.9 && std::abs(y) <= 51.9;
      if (std::abs(std::abs(x) - 52) < 0.2 || std::abs(std::abs(y) - 52) < 0.2) continue;
      ASSERT_EQ(image.shows[k], inside ? kMeasuredShown : kNothingShown) << x << " " << y;
      if (!inside) continue;
      ++shown;
      ASSERT_NEAR(image.z_mm[k], height(x, y), 0.02) << "what triangles of 1.3 mm leave of the curve";
      const double slope = std::hypot(-x / 75 + 8.0 / 15 * std::cos(x / 15), -y / 150);
      ASSERT_NEAR(image.sigma_mm[k], 0.2 * std::sqrt(1 + slope * slope), 0.02)
          << "along z, a slope makes it longer";
    }
  EXPECT_GT(shown, 40000u);
}

TEST(RangeImage, TheOutermostSurfaceCountsAndWhatWasCompletedIsSaid) {
  FaceMesh mesh(heap());
  add_sheet(mesh, 0, false, 1);
  add_sheet(mesh, 6, true, 1);  // nearer, but seen from behind: no surface of a face
  const std::size_t middle = 260u * 401u + 200u;
  EXPECT_NEAR(measure_range(mesh, {}, heap(), heap()).z_mm[middle], height(0, 0), 0.02);
  add_sheet(mesh, 3, false, 0);
  const RangeImage image = measure_range(mesh, {}, heap(), heap());
  EXPECT_NEAR(image.z_mm[middle], height(0, 0) + 3, 0.02);
  EXPECT_EQ(image.shows[middle], kCompletedShown);
}

TEST(RangeImage, StandsInTheHeadFrameWhereverTheFaceWas) {
  FaceMesh mesh(heap());
  add_sheet(mesh, 0, false, 1);
  const RangeImage straight = measure_range(mesh, {}, heap(), heap());
  RigidTransform head_from_camera;
  const double c = std::cos(0.4), s = std::sin(0.4);
  head_from_camera.rotation = {{c, 0, s, 0, 1, 0, -s, 0, c}};
  head_from_camera.translation_mm = {3, -20, 600};
  const RigidTransform camera_from_head = inverse(head_from_camera);
  for (Vec3f& v : mesh.vertices_mm) {
    const Vec3d p = apply(camera_from_head, Vec3d{double{v.x}, double{v.y}, double{v.z}});
    v = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  const RangeImage turned = measure_range(mesh, head_from_camera, heap(), heap());
  for (std::size_t k = 0; k < turned.z_mm.size(); ++k)
    if (turned.shows[k] != kNothingShown && straight.shows[k] != kNothingShown) {
      ASSERT_NEAR(turned.z_mm[k], straight.z_mm[k], 2e-3);
    }
}

// The whole way, judged by the surface the pictures were drawn from.
TEST(RangeImage, OfASimulatedFaceIsTheTrueSurface) {
  const hal::sim::SimRig rig = hal::sim::make_rig(test::small_rig(0.45));
  relievo::test::StageFixture fixture;
  StageContext& c = fixture.context;
  hal::sim::HeadPose pose;
  pose.yaw_deg = 12;
  const auto scene = hal::sim::make_head_scene(hal::sim::make_head(hal::sim::traits_of(5), fixture.pool),
                                               pose, fixture.pool);
  const auto pictures = hal::sim::render_pair(*scene, rig, {}, 1, fixture.pool);
  const auto pipeline = Pipeline::make({}, relievo::test::true_calibration(rig));
  ASSERT_TRUE(pipeline);
  auto meshed = relievo::test::mesh_of(*pipeline, {pictures.left.view(), pictures.right.view(), 0, 0}, c);
  ASSERT_TRUE(meshed);
  RectifiedPair& pair = meshed->pair;
  FaceMesh& mesh = meshed->mesh;
  auto texture = pipeline->texture(mesh, pair, c);
  ASSERT_TRUE(texture);
  const auto model = pipeline->assemble(std::move(mesh), *std::move(texture), pair, c);
  ASSERT_TRUE(model);
  const auto images = make_recognition_images(*model, *heap(), *heap());
  ASSERT_TRUE(images);

  const RigidTransform camera_from_head = inverse(model->head_from_camera);
  const RangeImage& range = images->range;
  const auto at = [&](double x, double y, double z) {
    const Vec3d p = apply(camera_from_head, Vec3d{x, y, z});
    return hal::sim::Vec3{p.x, p.y, p.z};
  };
  std::vector<double> off;
  std::size_t within = 0;
  for (int row = 0; row < range.height_px; row += 3)
    for (int column = 0; column < range.width_px; column += 3) {
      const auto k = static_cast<std::size_t>(row * range.width_px + column);
      if (range.shows[k] != kMeasuredShown) continue;
      const double x = range.first_mm.x + range.pitch_mm * column,
                   y = range.first_mm.y - range.pitch_mm * row, z = double{range.z_mm[k]};
      const hal::sim::Vec3 from = at(x, y, 60), to = at(x, y, 59);
      const hal::sim::Vec3 down{to.x - from.x, to.y - from.y, to.z - from.z};
      hal::sim::SolidPoint truth;
      if (!scene->solid(from, down, truth)) continue;
      const hal::sim::Vec3 base = at(x, y, z);
      const double d = (base.x - truth.point.x) * down.x + (base.y - truth.point.y) * down.y +
                       (base.z - truth.point.z) * down.z;
      off.push_back(std::abs(d));
      within += std::abs(d) < 2 * static_cast<double>(range.sigma_mm[k]) ? 1 : 0;
    }
  ASSERT_GT(off.size(), 3000u);
  const double half = median(off), p90 = percentile(off, 0.9);
  std::printf(
      "range image against the true surface at 864 x 540: median %.3f mm, 90 %% within %.3f mm, %.0f %% within 2 sigma (%zu pixels)\n",
      half, p90, 100.0 * static_cast<double>(within) / static_cast<double>(off.size()), off.size());
  EXPECT_LT(half, 0.25);
  EXPECT_LT(p90, 1.0);
}

}  // namespace
}  // namespace relievo::pipeline
