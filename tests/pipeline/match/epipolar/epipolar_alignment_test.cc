// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/epipolar/row_aligner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/bump_scene.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::StageFixture;

Pyramids pyramids_of(const RectifiedPair& pair, Arena& memory) {
  Pyramids pyramids{std::pmr::vector<PyramidLevel>(&memory), std::pmr::vector<PyramidLevel>(&memory)};
  for (auto* levels : {&pyramids.left, &pyramids.right}) {
    const RectifiedView& view = levels == &pyramids.left ? pair.left : pair.right;
    levels->emplace_back(&memory, pair.width_px, pair.height_px);
    std::copy(view.grey.begin(), view.grey.end(), levels->back().grey.values.begin());
    std::copy(view.valid.begin(), view.valid.end(), levels->back().valid.values.begin());
    for (int level = 1; level <= kCoarseLevel; ++level) {
      const PyramidLevel& from = (*levels)[static_cast<std::size_t>(level - 1)];
      PyramidLevel half(&memory, (from.grey.width + 1) / 2, (from.grey.height + 1) / 2);
      for (int y = 0; y < half.grey.height; ++y) halve_row(from, half, y);
      levels->push_back(std::move(half));
    }
  }
  return pyramids;
}

// On the true surface, or one that is `wrong_px` off in stripes.
EpipolarShift measured(const BumpScene& scene, StageFixture& fixture, double wrong_px = 0) {
  const RectifiedPair pair = scene.render(&fixture.output);
  const Pyramids pyramids = pyramids_of(pair, fixture.output);
  SurfaceField field(&fixture.output, pyramids.left[1].grey.width, pyramids.left[1].grey.height, 2);
  for (int j = 0; j < field.domain.height; ++j)
    for (int i = 0; i < field.domain.width; ++i) {
      field.domain.row(j)[i] = scene.judged(2 * i, 2 * j) ? 1 : 0;
      field.disparity_px.row(j)[i] =
          static_cast<float>(scene.disparity(2 * i, 2 * j) + (j / 12 % 2 == 0 ? wrong_px : -wrong_px));
    }
  return measure_epipolar_shift(pair, pyramids, field, EpipolarSearch::Search, fixture.context);
}

TEST(EpipolarAlignment, FindsOffsetAndTilt) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{16} << 20);
  for (const double rows : {-6.0, -0.5, -0.07, 0.0, 0.2, 1.3, 4.0}) {
    fixture.output.reset();
    const BumpScene scene{.width_px = 240, .height_px = 200, .rows_px = rows, .rows_tilt = 1e-3};
    const EpipolarShift shift = measured(scene, fixture);
    ASSERT_TRUE(shift.measured()) << rows;
    EXPECT_NEAR(shift.at(scene.width_px / 2.0, scene.height_px / 2.0), rows, 0.015 + 0.01 * std::abs(rows))
        << rows;
    EXPECT_NEAR(shift.slope_x, 1e-3, 2e-4) << rows;
    EXPECT_NEAR(shift.slope_y, 0, 2e-4) << rows;
  }
}

// Noise alone must not draw the answer anywhere, least of all to whole or half rows.
TEST(EpipolarAlignment, NoiseDoesNotBiasIt) {
  for (const double rows : {0.0, 0.5}) {
    double bias = 0, variance = 0;
    constexpr int kSeeds = 6;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
      StageFixture fixture(std::size_t{16} << 20, std::size_t{16} << 20);
      const EpipolarShift shift = measured(
          {.width_px = 240, .height_px = 200, .contrast = 5, .noise = 4, .seed = seed, .rows_px = rows},
          fixture);
      ASSERT_TRUE(shift.measured());
      bias += (shift.offset_px - rows) / kSeeds;
      variance += shift.covariance_px2[0] / (kSeeds * kSeeds);
    }
    EXPECT_LT(std::abs(bias), 3 * std::sqrt(variance)) << rows;
    EXPECT_LT(std::sqrt(variance), 0.05);
  }
}

TEST(EpipolarAlignment, ExposureAndAWrongSurfaceDoNotMatter) {
  StageFixture fixture(std::size_t{32} << 20, std::size_t{16} << 20);
  const EpipolarShift unequal = measured(
      {.width_px = 240, .height_px = 200, .right_gain = 0.6, .right_offset = 25, .rows_px = 0.2}, fixture);
  EXPECT_NEAR(unequal.offset_px, 0.2, 0.03);
  const EpipolarShift beside = measured({.width_px = 240, .height_px = 200, .rows_px = 0.2}, fixture, 0.8);
  EXPECT_NEAR(beside.offset_px, 0.2, 0.05);
}

TEST(EpipolarAlignment, APlainWallIsNotMeasured) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{16} << 20);
  EXPECT_FALSE(measured({.width_px = 200, .height_px = 160, .contrast = 0, .noise = 0}, fixture).measured());
}

TEST(EpipolarAlignment, ShiftedRowsAgree) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{16} << 20);
  BumpScene scene{.width_px = 200, .height_px = 160, .noise = 0, .rows_px = 1.4, .rows_tilt = -2e-3};
  const RectifiedPair moved = scene.render(&fixture.output);
  scene.rows_px = scene.rows_tilt = 0;
  const RectifiedPair still = scene.render(&fixture.output);
  Plane<float> right(&fixture.output, moved.width_px, moved.height_px);
  EpipolarShift shift;
  shift.offset_px = 1.4, shift.slope_x = -2e-3, shift.middle_x_px = moved.width_px / 2.0;
  shift_rows({shift}, moved.right.grey, right, fixture.context);
  double worst = 0;
  for (int y = 12; y < moved.height_px - 12; ++y)
    for (int x = 12; x < moved.width_px - 12; ++x)
      worst = std::max(
          worst, std::abs(static_cast<double>(
                     right.row(y)[x] - still.right.grey[static_cast<std::size_t>(y * moved.width_px + x)])));
  EXPECT_LT(worst, 6) << "of a texture of 20 grey levels' deviation, waves from 5 px on";
}

}  // namespace
}  // namespace relievo::pipeline
