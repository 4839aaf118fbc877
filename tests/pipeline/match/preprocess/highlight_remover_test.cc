// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/statistics.h"
#include "pipeline/match/preprocess/preprocessors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>
#include <vector>

#include "tests/pipeline/match/preprocess/shining_skin.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::kLeftLamp;
using test::kRightLamp;
using test::kSkinScene;
using test::Lamp;
using test::StageFixture;

struct HighlightFixture : StageFixture {
  explicit HighlightFixture(std::size_t scratch_bytes = std::size_t{2} << 20)
      : StageFixture(std::size_t{8} << 20, scratch_bytes) {}
  RectifiedPair skin(double light = kLeftLamp.light) {
    return test::shining_skin(kSkinScene, &output, light);
  }
  // A pair without a region is a face all over.
  Result<void> remove(RectifiedPair& pair) {
    if (pair.region.empty()) pair.region.assign(pair.left.grey.size(), 1);
    return run_stage(context, [&](StageContext& c) { return HighlightRemover({}).process(pair, c); });
  }
};

double rms_apart(const RectifiedView& a, const RectifiedView& b, int width_px, const Lamp& around,
                 double radii) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < a.grey.size(); ++k) {
    const double dx = static_cast<double>(k % static_cast<std::size_t>(width_px)) - around.x_px;
    const double dy = static_cast<double>(k / static_cast<std::size_t>(width_px)) - around.y_px;
    if (std::hypot(dx, dy) > radii * around.radius_px) continue;
    sum += std::pow(static_cast<double>(a.grey[k] - b.grey[k]), 2);
    ++n;
  }
  return std::sqrt(sum / n);
}

TEST(HighlightRemover, TakesAwayWhatALampAddsAndNothingElse) {
  HighlightFixture fixture;
  const RectifiedPair dull = fixture.skin(0), shining = fixture.skin();
  RectifiedPair done = fixture.skin();
  ASSERT_TRUE(fixture.remove(done));
  const double added = rms_apart(shining.left, dull.left, dull.width_px, kLeftLamp, 2);
  EXPECT_GT(added, 18);
  // What `least` leaves of it.
  EXPECT_LT(rms_apart(done.left, dull.left, dull.width_px, kLeftLamp, 2), 0.6 * added);
  EXPECT_LT(rms_apart(done.right, dull.right, dull.width_px, kRightLamp, 2), 0.6 * added);
  std::size_t far = 0;
  for (std::size_t k = 0; k < dull.left.grey.size(); ++k) {
    if (std::hypot(static_cast<double>(k % 200) - kLeftLamp.x_px,
                   static_cast<double>(k / 200) - kLeftLamp.y_px) < 5 * kLeftLamp.radius_px)
      continue;
    ASSERT_NEAR(done.left.grey[k], shining.left.grey[k], 0.5) << k;
    ++far;
  }
  EXPECT_GT(far, 10'000U);
}

// What single pores mirror differs between two cameras. `spoil` stands for what a camera does to colours.
struct ShiningPores : HighlightFixture {
  RectifiedPair painted(double light, double pores, const std::function<void(RectifiedView&)>& spoil) {
    test::BumpScene even = kSkinScene;  // even skin: its colours' noise stands above its texture
    even.contrast = 4, even.noise = 0.2;
    RectifiedPair pair = even.render(&output);
    for (RectifiedView* view : {&pair.left, &pair.right}) {
      test::paint_skin(*view, pair.width_px,
                       {kLeftLamp.x_px, kLeftLamp.y_px, kLeftLamp.radius_px, light, pores});
      spoil(*view);
    }
    return pair;
  }
  // From a pixel to the next, of what they mirror there: how much is left, and how much was changed (0.23 of
  // it by what is coarser), and what is said to be left.
  struct Shares {
    double left, changed, said;
  };
  Shares shares(const std::function<void(RectifiedView&)>& spoil) {
    const RectifiedPair dull = painted(0, 0, spoil), shining = painted(kLeftLamp.light, 0.3, spoil);
    RectifiedPair done = painted(kLeftLamp.light, 0.3, spoil);
    EXPECT_TRUE(remove(done));
    double before = 0, after = 0, change = 0;
    for (std::size_t k = 0; k + 1 < dull.left.grey.size(); ++k) {
      if (std::hypot(double(k % 200) - kLeftLamp.x_px, double(k / 200) - kLeftLamp.y_px) >
          kLeftLamp.radius_px)
        continue;
      const auto step = [k](const RectifiedPair& pair) { return pair.left.grey[k] - pair.left.grey[k + 1]; };
      before += std::pow(double(step(shining) - step(dull)), 2);
      after += std::pow(double(step(done) - step(dull)), 2);
      change += std::pow(double(step(done) - step(shining)), 2);
    }
    EXPECT_GT(before, 1000);
    return {std::sqrt(after / before), std::sqrt(change / before), double(done.left.pores_left)};
  }
};

TEST(HighlightRemover, KeepsHowMuchLampsAdd) {
  HighlightFixture fixture;
  const RectifiedPair dull = fixture.skin(0), shining = fixture.skin();
  RectifiedPair pair = fixture.skin();
  ASSERT_TRUE(fixture.remove(pair));
  for (const auto& [view, of, without, lamp] :
       {std::tuple{&pair.left, &shining.left, &dull.left, kLeftLamp},
        std::tuple{&pair.right, &shining.right, &dull.right, kRightLamp}}) {
    ASSERT_EQ(view->mirrored.size(), pair.pixels());
    const std::size_t at = pair.index(int(lamp.x_px), int(lamp.y_px));
    const float added = of->grey[at] - without->grey[at];
    EXPECT_GT(added, 20);
    EXPECT_NEAR(float(view->mirrored[at]), added, 0.35F * added);
    EXPECT_LT(view->mirrored[pair.index(20, 20)], 3);
  }
}

TEST(HighlightRemover, WhatPoresMirrorGoesWithIt) {
  const auto shares =
      ShiningPores().shares([](RectifiedView& view) {  // noise, so that dull skin has something to tell
        std::mt19937 random(7);
        for (std::uint8_t& v : view.rgb) v = std::uint8_t(std::clamp(int(v) + int(random() % 3) - 1, 0, 251));
      });
  EXPECT_LT(shares.left, 0.5);
  EXPECT_LT(shares.said, 0.05);
}

// Two greens, a red and a blue in every four pixels, and the rest put together from neighbours, as
// single-chip cameras do: what colours miss then hangs together from pixel to pixel.
TEST(HighlightRemover, ColoursOfASingleChipSayNothingOfPores) {
  const auto shares = ShiningPores().shares([](RectifiedView& view) {
    std::mt19937 random(7);
    for (std::uint8_t& v : view.rgb) v = std::uint8_t(std::clamp(int(v) + int(random() % 7) - 3, 0, 251));
    const std::vector<std::uint8_t> seen(view.rgb.begin(), view.rgb.end());
    for (int y = 1; y < 159; ++y)
      for (int x = 1; x < 199; ++x)
        for (int c = 0; c < 3; ++c) {
          int sum = 0, n = 0;
          for (int v = -1; v <= 1; ++v)
            for (int u = -1; u <= 1; ++u) {
              const int colour = (x + u) % 2 != (y + v) % 2 ? 1 : (y + v) % 2 * 2;
              const int weight = (2 - std::abs(u)) * (2 - std::abs(v));
              if (colour == c)
                sum += weight * seen[std::size_t(3 * ((y + v) * 200 + x + u) + c)], n += weight;
            }
          view.rgb[std::size_t(3 * (y * 200 + x) + c)] = std::uint8_t(sum / n);
        }
  });
  EXPECT_LT(shares.changed, 0.4);
  EXPECT_GT(shares.said, 0.95);
}

TEST(HighlightRemover, ColoursThatAreNoiseSayNothingOfPores) {
  const double changed = ShiningPores()
                             .shares([](RectifiedView& view) {
                               std::mt19937 random(7);
                               for (std::uint8_t& v : view.rgb)
                                 v = std::uint8_t(std::clamp(int(v) + int(random() % 41) - 20, 0, 251));
                             })
                             .changed;
  EXPECT_LT(changed, 0.3);
}

// Against the ratio of the whole face a lamp upon red lips would be no brighter than dull skin.
TEST(HighlightRemover, RedLipsAreAskedByTheirOwnColour) {
  HighlightFixture fixture;
  constexpr test::Lips kLips{90, 80, 40, 14};
  constexpr Lamp kLamp{90, 80, 5, 0.12};
  const auto painted = [&](double light) {
    RectifiedPair pair = kSkinScene.render(&fixture.output);
    for (RectifiedView* view : {&pair.left, &pair.right})
      paint_skin(*view, pair.width_px, {kLamp.x_px, kLamp.y_px, kLamp.radius_px, light}, kLips);
    pair.face_centre_px = {90, 80};
    pair.face_width_px = 300;  // lips of 28 px, a lamp's image of 20
    return pair;
  };
  const RectifiedPair dull = painted(0), shining = painted(kLamp.light);
  RectifiedPair done = painted(kLamp.light);
  ASSERT_TRUE(fixture.remove(done));
  const double added = rms_apart(shining.left, dull.left, dull.width_px, kLamp, 2);
  EXPECT_GT(added, 9);
  EXPECT_LT(rms_apart(done.left, dull.left, dull.width_px, kLamp, 2), 0.7 * added);
}

TEST(HighlightRemover, LooksOnlyWhereAFaceMayBe) {
  HighlightFixture fixture;
  const RectifiedPair shining = fixture.skin();
  for (const int top : {10, 70}) {
    RectifiedPair done = fixture.skin();
    done.region.assign(done.left.grey.size(), 0);
    for (int y = top; y < top + 20; ++y)
      std::fill_n(done.region.begin() + y * done.width_px + 40, 100, std::uint8_t{1});
    ASSERT_TRUE(fixture.remove(done));
    const double changed = rms_apart(done.left, shining.left, shining.width_px, kLeftLamp, 1);
    if (top == 10) EXPECT_EQ(changed, 0);
    else EXPECT_GT(changed, 5);
  }
}

TEST(HighlightRemover, WhereNoFaceIsLookedForNothingIsSkin) {
  HighlightFixture fixture;
  RectifiedPair pair = fixture.skin();
  pair.region.clear();
  const auto left = pair.left.grey, right = pair.right.grey;
  ASSERT_TRUE(
      run_stage(fixture.context, [&](StageContext& c) { return HighlightRemover({}).process(pair, c); }));
  EXPECT_EQ(pair.left.grey, left);
  EXPECT_EQ(pair.right.grey, right);
}

// Of two cameras exposed unlike, the brighter one sees skin whose red has reached its end: paler than it is,
// as under a lamp.
TEST(HighlightRemover, SkinWhoseRedIsOverexposedIsNoHighlight) {
  HighlightFixture fixture;
  RectifiedPair pair = fixture.skin(0);
  std::vector<std::uint8_t> reds;
  for (std::size_t k = 0; k < pair.left.grey.size(); ++k) reds.push_back(pair.left.rgb[3 * k]);
  const double gain = 262.0 / median(reds);
  for (std::uint8_t& v : pair.left.rgb) v = static_cast<std::uint8_t>(std::min(255L, std::lround(gain * v)));
  for (std::size_t k = 0; k < pair.left.grey.size(); ++k)
    pair.left.grey[k] =
        static_cast<float>(pair.left.rgb[3 * k] + pair.left.rgb[3 * k + 1] + pair.left.rgb[3 * k + 2]) / 3;
  std::size_t ended = 0;
  for (std::size_t k = 0; k < pair.left.grey.size(); ++k) ended += pair.left.rgb[3 * k] == 255 ? 1U : 0U;
  ASSERT_GT(ended, pair.left.grey.size() / 4);
  const auto before = pair.left.grey;
  ASSERT_TRUE(fixture.remove(pair));
  for (std::size_t k = 0; k < before.size(); ++k)
    ASSERT_NEAR(pair.left.grey[k], before[k], 0.75) << "x " << k % 200 << " y " << k / 200;
}

// The white of an eye, teeth: no skin. Right beside them two or three levels may go.
TEST(HighlightRemover, WhiteThingsStay) {
  HighlightFixture fixture;
  RectifiedPair pair = fixture.skin(0);
  for (int y = 60; y < 80; ++y)
    for (int x = 60; x < 90; ++x) {
      const auto k = static_cast<std::size_t>(y * pair.width_px + x);
      pair.left.grey[k] = 200;
      std::fill_n(pair.left.rgb.begin() + static_cast<std::ptrdiff_t>(3 * k), 3, std::uint8_t{200});
    }
  const auto before = pair.left.grey;
  ASSERT_TRUE(fixture.remove(pair));
  for (std::size_t k = 0; k < before.size(); ++k)
    ASSERT_NEAR(pair.left.grey[k], before[k], 3) << "x " << k % 200 << " y " << k / 200;
}

TEST(HighlightRemover, WithoutColourThereIsNothingToGoBy) {
  HighlightFixture fixture;
  RectifiedPair pair = fixture.skin();
  for (RectifiedView* view : {&pair.left, &pair.right})
    for (std::size_t k = 0; k < view->grey.size(); ++k)
      std::fill_n(view->rgb.begin() + static_cast<std::ptrdiff_t>(3 * k), 3,
                  static_cast<std::uint8_t>(view->grey[k]));
  const auto left = pair.left.grey, right = pair.right.grey;
  ASSERT_TRUE(fixture.remove(pair));
  EXPECT_EQ(pair.left.grey, left);
  EXPECT_EQ(pair.right.grey, right);
}

TEST(HighlightRemover, TooLittleMemoryIsAnError) {
  HighlightFixture fixture(std::size_t{64} << 10);
  RectifiedPair pair = fixture.skin();
  const auto done = fixture.remove(pair);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::OutOfMemory);
}

}  // namespace
}  // namespace relievo::pipeline
