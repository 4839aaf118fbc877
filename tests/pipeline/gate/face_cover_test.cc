// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/head_outline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/gate/seen_relief.h"

namespace relievo::pipeline {
namespace {

const HeadHint kHint{{150, 140}, 150 / kPixelMm};

// A face as an egg of 70 x 95 mm that falls back by 60 mm to its rim, on a neck 65 mm behind its chin, before
// a room without depth.
double face(double right, double down) {
  const double a = right / 70, b = down / (down < 0 ? 100 : 78), rim = a * a + b * b;
  if (rim < 1) return kFaceDistanceMm + 60 * rim * rim;
  return std::abs(right) < 50 && down > 60 ? kFaceDistanceMm + 85 : 0;
}

// What stands nearer than the face (`before`) hides from one camera a strip beside it.
double share_before(const Depth& before) {
  SeenRelief work(300, 300, {150, 140});
  Relief& relief = work.relief;
  for (int y = 0; y < relief.height_px; ++y) {
    double hidden_until = -1e9;
    for (int x = 0; x < relief.width_px; ++x) {
      const double right = (x - kHint.centre_px.x) * kPixelMm, down = (y - kHint.centre_px.y) * kPixelMm;
      const double here = before ? before(right, down) : 0, own = face(right, down);
      if (here > 0 && own > 0) hidden_until = right + 140 * (own - here) / here;
      const double z = here > 0 ? here : right < hidden_until ? 0 : own;
      relief.depth_mm[relief.index(x, y)] = static_cast<float>(z);
    }
  }
  label_surfaces(relief, work.context);
  return covered_share(relief, kHint);
}

Depth plate(double right, double down, double width, double height, double nearer_mm) {
  return [=](double x, double y) {
    return std::abs(x - right) < width / 2 && std::abs(y - down) < height / 2 ? kFaceDistanceMm - nearer_mm
                                                                              : 0;
  };
}

TEST(FaceCover, AFaceAloneHidesNothing) { EXPECT_EQ(share_before({}), 0); }

TEST(FaceCover, SeesWhatStandsBeforeAFace) {
  EXPECT_NEAR(share_before(plate(0, 35, 80, 60, 45)), 0.35, 0.12) << "a hand before the mouth";
  EXPECT_GT(share_before(plate(30, -25, 45, 60, 20)), 0.1) << "a hand over an eye, near the skin";
  EXPECT_GT(share_before(plate(0, -40, 130, 50, 60)), 0.2) << "a sheet before the eyes";
  EXPECT_GT(share_before(plate(0, 0, 20, 150, 40)), 0.05) << "a stick";
}

TEST(FaceCover, LeavesAloneWhatDoesNotCover) {
  const Depth fringe = [](double x, double y) {
    return std::abs(x) < 50 && std::abs(y + 55) < 25 ? face(x, y) - 7 : 0;
  };
  EXPECT_EQ(share_before(fringe), 0) << "a fringe, glasses";
  EXPECT_EQ(share_before(plate(0, 30, 14, 14, 40)), 0) << "a finger's tip";
  EXPECT_EQ(share_before(plate(140, 60, 60, 60, 100)), 0) << "a hand that waves beside the face";
}

}  // namespace
}  // namespace relievo::pipeline
