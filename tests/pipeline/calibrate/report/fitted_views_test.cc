// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/calibrator.h"

#include <gtest/gtest.h>

#include "tests/pipeline/calibrate/report/reported_set.h"

namespace relievo::tests {
namespace {

using pipeline::CornerResidual;
using pipeline::FittedView;

// Root mean square over the corners that took part.
double rms(std::initializer_list<const std::vector<CornerResidual>*> lists) {
  double sum = 0;
  int count = 0;
  for (const auto* list : lists)
    for (const CornerResidual& c : *list) {
      if (!pipeline::seen(c.at)) continue;
      sum += c.off.x * c.off.x + c.off.y * c.off.y;
      ++count;
    }
  return std::sqrt(sum / count);
}

TEST(FittedViews, ResidualsAreThoseOfTheFit) {
  ReportedSet set;
  const auto& q = set.output.quality;
  ASSERT_EQ(set.output.views.size(), 15U);
  EXPECT_FALSE(q.views[12].used);
  double sum = 0;
  int corners = 0;
  for (std::size_t v = 0; v < q.views.size(); ++v) {
    const FittedView& view = set.output.views[v];
    EXPECT_TRUE(view.placed);
    if (!q.views[v].used) continue;
    EXPECT_NEAR(rms({&view.left}), q.views[v].left_rms_px, 1e-6) << v;
    EXPECT_NEAR(rms({&view.right}), q.views[v].right_rms_px, 1e-6) << v;
    for (const auto* list : {&view.left, &view.right})
      for (const CornerResidual& c : *list)
        if (pipeline::seen(c.at)) {
          sum += c.off.x * c.off.x + c.off.y * c.off.y;
          ++corners;
        }
  }
  EXPECT_NEAR(std::sqrt(sum / corners), q.pair_rms_px, 1e-9);
}

TEST(FittedViews, KnowWhatWasNotSeen) {
  ReportedSet set;
  EXPECT_TRUE(set.output.views[5].left.empty()) << "no board in left";
  EXPECT_EQ(set.output.views[5].right.size(), 54U);
  EXPECT_FALSE(pipeline::seen(set.output.views[2].right[7].at)) << "a stray was dropped";
  EXPECT_NE(set.output.views[2].right[7].off.x, set.output.views[2].right[7].off.x);
  const pipeline::Vec2d& seen_at = set.boards.input().views[2].right[8];
  EXPECT_EQ(set.output.views[2].right[8].at.x, seen_at.x);
  EXPECT_EQ(set.output.views[2].right[8].at.y, seen_at.y);
}

// A pair left out stands in each camera's own place: there is nothing wrong with its corners.
TEST(FittedViews, APairLeftOutStillFitsEachCameraAlone) {
  ReportedSet set;
  const FittedView& slipped = set.output.views[12];
  EXPECT_LT(rms({&slipped.left}), 0.15);
  EXPECT_LT(rms({&slipped.right}), 0.15);
}

// Boards on a perfect rig come out where they were held.
TEST(FittedViews, BoardsStandWhereTheyWereHeld) {
  ReportedSet set;
  for (std::size_t v = 0; v < set.output.views.size(); ++v) {
    if (!set.output.quality.views[v].used) continue;
    const auto& pattern = set.boards.input().pattern;
    const pipeline::Vec3d middle = apply(set.output.views[v].left_from_board,
                                         pipeline::Vec3d{0.5 * (pattern.columns - 1) * pattern.square_mm,
                                                         0.5 * (pattern.rows - 1) * pattern.square_mm, 0});
    EXPECT_NEAR(std::hypot(middle.x, middle.y, middle.z), set.output.quality.views[v].distance_mm, 1e-3);
    // Corners 22 and 31 lie on both sides of it: the true rig sees it between them, as far as the
    // calibration knows where its own picture's middle is.
    const pipeline::Vec2d at = seen_by(SimulatedRig{}, 0, {middle.x, middle.y, middle.z});
    const auto& left = set.boards.input().views[v].left;
    const auto& sigma = set.output.quality.uncertainty.parameters.lens[0];
    EXPECT_NEAR(at.x, 0.5 * (left[22].x + left[31].x), 1 + 4 * sigma[2]) << v;
    EXPECT_NEAR(at.y, 0.5 * (left[22].y + left[31].y), 1 + 4 * sigma[3]) << v;
  }
}

}  // namespace
}  // namespace relievo::tests
