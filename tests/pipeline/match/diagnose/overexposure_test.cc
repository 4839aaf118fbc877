// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shares of white on faces whose white is painted where it is known.
#include "pipeline/match/diagnose/pair_diagnosis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory_resource>

namespace relievo::pipeline {
namespace {

constexpr int kExposedWidth = 600, kExposedHeight = 500;
constexpr int kFaceX = 250, kFaceY = 240, kFaceWidth = 200, kDisparity = 60;

RectifiedPair grey_pair() {
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = kExposedWidth;
  pair.height_px = kExposedHeight;
  pair.focal_px = 1000;
  pair.near_mm = 650;
  pair.far_mm = 850;
  for (RectifiedView* view : {&pair.left, &pair.right}) {
    view->grey.assign(std::size_t{kExposedWidth} * kExposedHeight, 100.0F);
    view->valid.assign(view->grey.size(), 1);
  }
  pair.face_centre_px = {kFaceX, kFaceY};
  pair.face_width_px = kFaceWidth;
  return pair;
}

void whiten(RectifiedView& view, int left, int right) {
  for (int y = 0; y < kExposedHeight; ++y)
    for (int x = left; x < right; ++x) view.grey[static_cast<std::size_t>(y * kExposedWidth + x)] = 255;
}

MatchSet matches_at(float disparity) {
  MatchSet set(std::pmr::get_default_resource());
  for (int i = -50; i < 50; ++i) set.matches.push_back({{static_cast<float>(kFaceX + i), kFaceY}, disparity});
  Match wrong{{kFaceX, kFaceY}, 400};
  wrong.rejected_by = 1;
  set.matches.push_back(wrong);
  set.matches.push_back({{10, 10}, 400});  // of the wall
  return set;
}

TEST(Overexposure, IsTheShareOfTheFaceThatIsWhite) {
  RectifiedPair pair = grey_pair();
  EXPECT_EQ(measure_overexposure(pair, matches_at(kDisparity)).left, 0);
  whiten(pair.left, 0, kFaceX);                                 // half of the face
  whiten(pair.right, kFaceX - kDisparity + 40, kExposedWidth);  // what lies right of half its half width
  const Overexposure white = measure_overexposure(pair, matches_at(kDisparity));
  EXPECT_NEAR(white.left, 0.5, 0.01);
  EXPECT_NEAR(white.right, (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / 3.14159265, 0.01)
      << "a circle's cap, for an ellipse is a circle stretched";
}

TEST(Overexposure, AWhiteWallIsNone) {
  RectifiedPair pair = grey_pair();
  whiten(pair.left, 0, kFaceX - kFaceWidth / 2);
  whiten(pair.left, kFaceX + kFaceWidth / 2, kExposedWidth);
  whiten(pair.right, kFaceX - kDisparity + kFaceWidth / 2, kExposedWidth);
  const Overexposure white = measure_overexposure(pair, matches_at(kDisparity));
  EXPECT_EQ(white.left, 0);
  EXPECT_EQ(white.right, 0);
}

TEST(Overexposure, WhereNoFaceWasLookedForNothingIsSaid) {
  RectifiedPair pair = grey_pair();
  pair.face_width_px = 0;
  whiten(pair.left, 0, kExposedWidth);
  EXPECT_EQ(measure_overexposure(pair, matches_at(kDisparity)).left, 0);
}

// Parallel cameras see it beside the middle of their pictures, toed-in ones in it.
TEST(Overexposure, OfAFaceNobodyFoundIsLookedForBeforeTheMiddleOfTheRig) {
  constexpr int kAside = 80;  // half the baseline there
  for (const int toed_in : {0, kAside}) {
    RectifiedPair pair = grey_pair();
    pair.baseline_mm = 120;
    pair.left_centre_px = {kExposedWidth / 2.0 - toed_in, kExposedHeight / 2.0};
    pair.right_centre_px = {kExposedWidth / 2.0 + toed_in, kExposedHeight / 2.0};
    const int in_left = kExposedWidth / 2 - toed_in + kAside, in_right = kExposedWidth / 2 + toed_in - kAside;
    whiten(pair.right, in_right - 100, in_right + 100);
    EXPECT_EQ(guess_overexposure(pair).left, 0);
    EXPECT_EQ(guess_overexposure(pair).right, 1) << "150 mm are 200 px here";
    whiten(pair.left, in_left - 100, in_left + 100);
    EXPECT_EQ(guess_overexposure(pair).left, 1);
  }
}

}  // namespace
}  // namespace relievo::pipeline
