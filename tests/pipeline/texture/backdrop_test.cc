// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The backdrop of a simulated face against the photograph it was made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal/sim/head/shape/head_traits.h"
#include "hal/sim/render.h"
#include "pipeline/pipeline.h"
#include "tests/support/meshed_pair.h"
#include "tests/support/rig_calibration.h"
#include "tests/support/small_rig.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

TEST(Backdrop, ShowsWhatThePhotographShowedAroundTheFaceAndFadesToNothing) {
  const hal::sim::SimRig rig(hal::sim::make_rig(test::small_rig(0.45)));
  test::StageFixture fixture;
  const auto scene =
      hal::sim::make_head_scene(hal::sim::make_head(hal::sim::traits_of(3), fixture.pool), {}, fixture.pool);
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
  const auto model = pipeline->assemble(std::move(mesh), *std::move(texture), pair, c);
  ASSERT_TRUE(model);

  const Backdrop& b = model->backdrop;
  ASSERT_EQ(b.at_mm.size(), static_cast<std::size_t>(b.columns) * static_cast<std::size_t>(b.rows));
  ASSERT_EQ(b.rgba.size(), b.at_mm.size());
  std::size_t shown = 0, above = 0, neck = 0;
  for (int row = 0; row < b.rows; ++row)
    for (int column = 0; column < b.columns; ++column) {
      const std::size_t k = static_cast<std::size_t>(row) * static_cast<std::size_t>(b.columns) +
                            static_cast<std::size_t>(column);
      const bool edge = row == 0 || column == 0 || row + 1 == b.rows || column + 1 == b.columns;
      EXPECT_TRUE(!edge || b.rgba[k][3] == 0) << "column " << column << ", row " << row;
      if (b.rgba[k][3] < 200) continue;
      ++shown;
      const Vec3f& p = b.at_mm[k];
      const Vec3d in_head =
          apply(model->head_from_camera,
                {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
      if (in_head.y > 105) ++above;
      if (in_head.y < -30) {
        ++neck;
        EXPECT_GT(b.rgba[k][0], 1.15 * b.rgba[k][2]) << "skin is redder than the grey room beside a jaw";
      }
      const Vec3d q = apply(pair.rectified_from_left,
                            {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
      const auto at = [&](double centre, double aside) {
        return static_cast<std::size_t>(std::lround(centre + pair.focal_px * aside / q.z));
      };
      const std::size_t x = at(pair.left_centre_px.x, q.x), y = at(pair.left_centre_px.y, q.y);
      ASSERT_LT(x, static_cast<std::size_t>(pair.width_px));
      ASSERT_LT(y, static_cast<std::size_t>(pair.height_px));
      int brightest = 0;  // of what it may be the mean of
      for (int dy = -14; dy <= 14; ++dy)
        for (int dx = -14; dx <= 14; ++dx) {
          const std::size_t u = std::clamp<std::size_t>(x + static_cast<std::size_t>(dx), 0,
                                                        static_cast<std::size_t>(pair.width_px) - 1);
          const std::size_t v = std::clamp<std::size_t>(y + static_cast<std::size_t>(dy), 0,
                                                        static_cast<std::size_t>(pair.height_px) - 1);
          brightest = std::max(
              brightest,
              static_cast<int>(pair.left.rgb[3 * (v * static_cast<std::size_t>(pair.width_px) + u)]));
        }
      EXPECT_LE(b.rgba[k][0], brightest) << "nothing is brighter than the photograph";
    }
  EXPECT_GT(shown, 500U);
  EXPECT_GT(neck, 20U);
  EXPECT_GT(above, 20U) << "hair, above what is measured of a face";
}

}  // namespace
}  // namespace relievo::pipeline
