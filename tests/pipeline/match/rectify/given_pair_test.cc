// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/rectify/rectifier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kGivenWidth = 70;
constexpr int kGivenHeight = 50;

struct Pictures {
  std::vector<std::byte> grey = std::vector<std::byte>(kGivenWidth * kGivenHeight);
  std::vector<std::byte> rgb = std::vector<std::byte>(3 * kGivenWidth * kGivenHeight);
  Pictures() {
    for (std::size_t k = 0; k < grey.size(); ++k) grey[k] = static_cast<std::byte>(k % 251);
    for (std::size_t k = 0; k < rgb.size(); ++k) rgb[k] = static_cast<std::byte>(k * 7 % 253);
  }
  StereoFrame frame() const {
    return {{grey.data(), kGivenWidth, kGivenHeight, kGivenWidth, PixelFormat::Grey8},
            {rgb.data(), kGivenWidth, kGivenHeight, 3 * kGivenWidth, PixelFormat::Rgb8}};
  }
};

TEST(GivenPair, TakesEveryPixelAsItIs) {
  const Pictures pictures;
  test::StageFixture fixture(std::size_t{1} << 20, std::size_t{1} << 16, 2);
  const auto pair = take_rectified(pictures.frame(), {0, 64}, fixture.context);
  ASSERT_TRUE(pair);
  ASSERT_EQ(pair->width_px, kGivenWidth);
  for (const std::size_t k : {0U, 777U, 3499U}) {
    EXPECT_EQ(pair->left.grey[k], static_cast<float>(k % 251));
    EXPECT_EQ(pair->left.rgb[3 * k + 1], k % 251);
    EXPECT_EQ(pair->left.valid[k], 1);
    const auto channel = [k](std::size_t i) { return static_cast<float>((3 * k + i) * 7 % 253); };
    EXPECT_NEAR(pair->right.grey[k], (channel(0) + channel(1) + channel(2)) / 3, 1e-4);
    EXPECT_EQ(pair->right.rgb[3 * k + 2], static_cast<std::uint8_t>(channel(2)));
  }
}

TEST(GivenPair, TheNominalRigHoldsTheRangeWhateverItsSign) {
  const Pictures pictures;
  test::StageFixture fixture(std::size_t{4} << 20, std::size_t{1} << 16, 1);
  for (const DisparityRange range :
       {DisparityRange{0, 256}, DisparityRange{-40, 30}, DisparityRange{12, 60}, DisparityRange{-90, -20}}) {
    const auto pair = take_rectified(pictures.frame(), range, fixture.context);
    ASSERT_TRUE(pair);
    EXPECT_GT(pair->near_mm, 0);
    EXPECT_LT(pair->near_mm, pair->far_mm);
    EXPECT_TRUE(std::isfinite(pair->far_mm));
    EXPECT_NEAR(pair->disparity_px(pair->near_mm), range.most_px, 1e-9);
    EXPECT_NEAR(pair->disparity_px(pair->far_mm), range.least_px, 1e-9);
  }
}

TEST(GivenPair, RefusesWhatIsNoPair) {
  const Pictures pictures;
  test::StageFixture fixture(std::size_t{1} << 20, std::size_t{1} << 16, 1);
  StereoFrame frame = pictures.frame();
  EXPECT_FALSE(take_rectified(frame, {9, 9}, fixture.context));
  EXPECT_FALSE(take_rectified(frame, {0, 5000}, fixture.context));
  frame.right.width_px = 60;
  EXPECT_EQ(take_rectified(frame, {0, 64}, fixture.context).error().code, Errc::InvalidInput);
  frame.right = {};
  EXPECT_EQ(take_rectified(frame, {0, 64}, fixture.context).error().code, Errc::InvalidInput);
  test::StageFixture tiny(1024, 1024, 1);
  const auto starved = run_stage(tiny.context, [&](StageContext& c) {
    return take_rectified(pictures.frame(), {0, 64}, c);
  });
  EXPECT_EQ(starved.error().code, Errc::OutOfMemory);
}

}  // namespace
}  // namespace relievo::pipeline
