// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pipeline.h"

#include <gtest/gtest.h>

#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "tests/support/meshed_pair.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

// Who stops it does not lose what it was to be made of: a technician assembles it again.
TEST(Pipeline, AnAssemblyThatWasStoppedCanBeDoneAgain) {
  const hal::sim::SimRig rig(hal::sim::make_rig(test::small_rig(0.3)));
  test::StageFixture fixture;
  const auto scene =
      hal::sim::make_head_scene(hal::sim::make_head(hal::sim::traits_of(1), fixture.pool), {}, fixture.pool);
  const auto l = hal::sim::read_sensor(hal::sim::expose(*scene, rig.left, {}, fixture.pool), {}, 1);
  const auto r = hal::sim::read_sensor(hal::sim::expose(*scene, rig.right, {}, fixture.pool), {}, 2);
  const auto pipeline = Pipeline::make({}, test::true_calibration(rig));
  ASSERT_TRUE(pipeline);
  StageContext& c = fixture.context;
  auto meshed = test::mesh_of(*pipeline, {l.view(), r.view(), 0, 0}, c);
  ASSERT_TRUE(meshed);
  RectifiedPair& pair = meshed->pair;
  FaceMesh& mesh = meshed->mesh;
  auto texture = pipeline->texture(mesh, pair, c);
  ASSERT_TRUE(texture);
  const std::size_t vertices = mesh.vertices_mm.size();

  fixture.cancelled = true;
  const auto stopped = pipeline->assemble(std::move(mesh), *std::move(texture), pair, c);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, Errc::Cancelled);
  ASSERT_EQ(mesh.vertices_mm.size(), vertices);
  fixture.cancelled = false;
  const auto model = pipeline->assemble(std::move(mesh), *std::move(texture), pair, c);
  ASSERT_TRUE(model) << model.error().what.view();
  EXPECT_EQ(model->mesh.vertices_mm.size(), vertices);
  EXPECT_FALSE(model->texture.rgb.empty());
}

}  // namespace
}  // namespace relievo::pipeline
