// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A wall with a nose on it: what lies further from its tip than the reach goes, and nothing else.
#include "pipeline/match/region/face_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kWallStep = 4;
constexpr double kWall = 600;  // mm
constexpr double kTip = 570;

struct Wall {
  test::StageFixture fixture{std::size_t{8} << 20, std::size_t{8} << 20};
  RectifiedPair pair{&fixture.output};
  SurfaceField field{&fixture.output, 240, 150, kWallStep};

  Wall() {
    pair.width_px = 960;
    pair.height_px = 600;
    pair.focal_px = 1500;
    pair.baseline_mm = 110;
    pair.left_centre_px = {480, 300};
    pair.right_centre_px = {480, 300};
    pair.near_mm = 400;
    pair.far_mm = 750;
    pair.face_centre_px = {480, 300};
    pair.face_width_px = 380;
    pair.face_reach_mm = 120;
    for (int j = 0; j < field.domain.height; ++j)
      for (int i = 0; i < field.domain.width; ++i) {
        field.domain.row(j)[i] = 1;
        field.disparity_px.row(j)[i] = static_cast<float>(pair.disparity_px(depth(i, j)));
      }
  }
  // A cone.
  static double depth(int i, int j) {
    return std::min(kWall, kTip + (kWall - kTip) * std::hypot(i * kWallStep - 480, j * kWallStep - 300) / 40);
  }
  double from_tip_mm(int i, int j) const {
    const double z = depth(i, j);
    return std::hypot((i * kWallStep - 480) * z / 1500, (j * kWallStep - 300) * z / 1500, z - kTip);
  }
  long kept() const { return std::count(field.domain.values.begin(), field.domain.values.end(), 1); }
};

TEST(FaceReach, KeepsWhatIsNearTheTipAndNothingElse) {
  Wall wall;
  keep_within_reach(wall.pair, wall.fixture.context, wall.field);
  for (int j = 0; j < wall.field.domain.height; ++j)
    for (int i = 0; i < wall.field.domain.width; ++i) {
      const double far = wall.from_tip_mm(i, j);
      const int in = wall.field.domain.row(j)[i];
      EXPECT_TRUE(far >= 117 || in == 1) << far;
      EXPECT_TRUE(far <= 123 || in == 0) << far;
    }
  EXPECT_EQ(wall.fixture.scratch.used(), 0U);
}

TEST(FaceReach, LeavesAloneWhatHasNoFaceOrNoReach) {
  for (const bool face : {true, false}) {
    Wall wall;
    (face ? wall.pair.face_reach_mm : wall.pair.face_width_px) = 0;
    const long before = wall.kept();
    keep_within_reach(wall.pair, wall.fixture.context, wall.field);
    EXPECT_EQ(wall.kept(), before);
  }
}

TEST(FaceReach, AHoleInTheMiddleSaysNothing) {
  Wall wall;
  for (int j = 0; j < wall.field.domain.height; ++j)
    for (int i = 0; i < wall.field.domain.width; ++i)
      if (std::hypot(i * kWallStep - 480, j * kWallStep - 340) < 120) wall.field.domain.row(j)[i] = 0;
  const long before = wall.kept();
  keep_within_reach(wall.pair, wall.fixture.context, wall.field);
  EXPECT_EQ(wall.kept(), before);
}

}  // namespace
}  // namespace relievo::pipeline
