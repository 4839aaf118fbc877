// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every preprocessor keeps, whichever it is, and what each is for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "pipeline/algorithms.h"
#include "pipeline/match/preprocess/preprocessors.h"
#include "tests/pipeline/match/preprocess/shining_skin.h"
#include "tests/support/bump_scene.h"
#include "tests/support/names_of.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::kSkinScene;
using test::StageFixture;

// Small enough for the slowest sanitizer, rendered once.
const RectifiedPair& shining_pair() {
  static const RectifiedPair pair =
      test::shining_skin(kSkinScene, std::pmr::get_default_resource(), test::kLeftLamp.light);
  return pair;
}

struct PreprocessFixture : StageFixture {
  explicit PreprocessFixture(int threads = 2)
      : StageFixture(std::size_t{8} << 20, std::size_t{2} << 20, threads) {}
  RectifiedPair scene() {
    RectifiedPair pair(&output);
    pair = shining_pair();
    return pair;
  }
};

Preprocessor make(const std::string& name, const test::Settings& settings = {}) {
  return test::made(&Algorithms::preprocessor, "preprocessor", name, settings);
}

Result<RectifiedPair> run(const Preprocessor& preprocessor, const RectifiedPair& pair,
                          StageFixture& fixture) {
  return run_stage(fixture.context, [&](StageContext& c) -> Result<RectifiedPair> {
    RectifiedPair mine(&c.output);
    mine = pair;
    RELIEVO_TRY(preprocessor(mine, c));
    return mine;
  });
}

class PreprocessorContract : public testing::TestWithParam<std::string> {};

TEST_P(PreprocessorContract, ChangesGreyValuesAndNothingElse) {
  PreprocessFixture fixture;
  RectifiedPair pair = fixture.scene();
  pair.region.assign(pair.left.grey.size(), 1);
  pair.region[5] = 0;
  const auto done = run(make(GetParam()), pair, fixture);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->left.rgb, pair.left.rgb);
  EXPECT_EQ(done->right.valid, pair.right.valid);
  EXPECT_EQ(done->region, pair.region);
  EXPECT_EQ(done->width_px, pair.width_px);
  EXPECT_EQ(done->focal_px, pair.focal_px);
  EXPECT_NE(done->right.grey, pair.right.grey);
  EXPECT_EQ(done->left.grey.get_allocator().resource(), &fixture.output);
  for (const RectifiedView* view : {&done->left, &done->right})
    for (const float grey : view->grey) ASSERT_TRUE(grey >= 0 && grey <= 255) << grey;
}

TEST_P(PreprocessorContract, APairWithoutPixelsIsRefused) {
  PreprocessFixture fixture;
  const auto done = run(make(GetParam()), RectifiedPair(&fixture.output), fixture);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::InvalidInput);
}

TEST_P(PreprocessorContract, AViewThatSeesNothingStays) {
  PreprocessFixture fixture;
  RectifiedPair pair = fixture.scene();
  std::fill(pair.right.valid.begin(), pair.right.valid.end(), std::uint8_t{0});
  const auto done = run(make(GetParam()), pair, fixture);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->right.grey, pair.right.grey);
}

TEST_P(PreprocessorContract, FlatPicturesStayFinite) {
  PreprocessFixture fixture;
  RectifiedPair pair = fixture.scene();
  for (const float level : {0.0F, 128.0F, 255.0F}) {
    std::fill(pair.left.grey.begin(), pair.left.grey.end(), level);
    std::fill(pair.right.grey.begin(), pair.right.grey.end(), 255 - level);
    std::fill(pair.left.rgb.begin(), pair.left.rgb.end(), static_cast<std::uint8_t>(level));
    std::fill(pair.right.rgb.begin(), pair.right.rgb.end(), static_cast<std::uint8_t>(255 - level));
    const auto done = run(make(GetParam()), pair, fixture);
    ASSERT_TRUE(done);
    for (const float grey : done->right.grey) ASSERT_EQ(grey, done->right.grey.front());
    ASSERT_TRUE(std::isfinite(done->right.grey.front()));
  }
}

TEST_P(PreprocessorContract, StopsWhenAsked) {
  PreprocessFixture fixture;
  RectifiedPair pair = fixture.scene();
  fixture.cancelled = true;
  const auto done = make(GetParam())(pair, fixture.context);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::Cancelled);
}

TEST_P(PreprocessorContract, GivesTheSameBytesForAnyNumberOfThreads) {
  std::vector<float> first;
  for (const int threads : {1, 2, 3, 2}) {
    PreprocessFixture fixture(threads);
    const auto done = run(make(GetParam()), fixture.scene(), fixture);
    ASSERT_TRUE(done);
    std::vector<float> all(done->left.grey.begin(), done->left.grey.end());
    all.insert(all.end(), done->right.grey.begin(), done->right.grey.end());
    if (first.empty()) first = all;
    ASSERT_EQ(first, all) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(All, PreprocessorContract, testing::ValuesIn(test::names_of("preprocessor")),
                         [](const auto& name) { return test::test_name(name.param); });

// How the right camera's exposure may differ: 255 * gain * (grey / 255)^gamma + offset.
struct Exposure {
  double gain, offset, gamma;
};

void expose(RectifiedPair& pair, const Exposure& e) {
  for (float& grey : pair.right.grey)
    grey = static_cast<float>(
        255 * e.gain * std::pow(std::max(0.0, static_cast<double>(grey)) / 255, e.gamma) + e.offset);
}

// Rms of left minus its true partner over the left view's standard deviation, where the scene is seen twice.
double unlikeness(const BumpScene& scene, const RectifiedPair& pair) {
  double n = 0, sum = 0, squares = 0, apart = 0;
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      if (!scene.judged(x, y)) continue;
      const double at = x - scene.disparity(x, y);
      const int column = static_cast<int>(at);
      const float* right = pair.right.grey.data() + static_cast<std::ptrdiff_t>(y) * pair.width_px + column;
      const double partner =
          static_cast<double>(right[0]) + (at - column) * static_cast<double>(right[1] - right[0]);
      const double left =
          static_cast<double>(pair.left.grey[static_cast<std::size_t>(y * pair.width_px + x)]);
      ++n;
      sum += left;
      squares += left * left;
      apart += (left - partner) * (left - partner);
    }
  return std::sqrt(apart / n / (squares / n - sum * sum / n / n));
}

constexpr Exposure kExposures[] = {{0.6, 0, 1},   {1, 40, 1},    {0.5, 90, 1},
                                   {0.9, 0, 0.6}, {0.9, 5, 1.8}, {0.7, 30, 1.4}};

TEST(Preprocessors, ExposuresAreUndone) {
  for (const std::uint32_t seed : {1U, 2U}) {
    BumpScene scene = kSkinScene;
    scene.noise = 0.3;
    scene.right_gain = 1;
    scene.seed = seed;
    PreprocessFixture fixture;
    const RectifiedPair alike = scene.render(&fixture.output);
    const double least = unlikeness(scene, alike);  // noise and interpolation
    EXPECT_LT(least, 0.12);
    for (const Exposure& exposure : kExposures) {
      Arena::Mark mark(fixture.output);
      RectifiedPair pair(&fixture.output);
      pair = alike;
      expose(pair, exposure);
      EXPECT_GT(unlikeness(scene, pair), 3 * least) << "this exposure is no trial";
      for (const std::string name : {"histogram-normalise", "histogram-match"}) {
        const auto done = run(make(name), pair, fixture);
        ASSERT_TRUE(done);
        // The views show a slightly different part of the scene: their histograms are not the same.
        EXPECT_LT(unlikeness(scene, *done), 0.15) << name << " gain " << exposure.gain << " offset "
                                                  << exposure.offset << " gamma " << exposure.gamma;
      }
    }
  }
}

TEST(Preprocessors, TheStretchUndoesGainAndOffsetAndKeepsProportions) {
  BumpScene scene = kSkinScene;
  scene.noise = 0.3;
  scene.right_gain = 1;
  PreprocessFixture fixture;
  RectifiedPair pair = scene.render(&fixture.output);
  expose(pair, {0.5, 90, 1});
  const auto done = run(make("histogram-normalise", {{"histogram-normalise.equalise", "0"}}), pair, fixture);
  ASSERT_TRUE(done);
  EXPECT_LT(unlikeness(scene, *done), 0.15);
  // Three grey values in a row keep the ratio of their distances.
  const auto& before = pair.left.grey;
  const auto& after = done->left.grey;
  std::size_t checked = 0;
  for (std::size_t k = 2; k < before.size(); k += 97) {
    const bool inside = std::all_of(after.begin() + static_cast<std::ptrdiff_t>(k) - 2,
                                    after.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                                    [](float v) { return v > 1 && v < 254; });
    if (!inside || std::abs(before[k] - before[k - 2]) < 4) continue;
    const float was = (before[k - 1] - before[k - 2]) / (before[k] - before[k - 2]);
    EXPECT_NEAR((after[k - 1] - after[k - 2]) / (after[k] - after[k - 2]), was,
                0.01F + 0.01F * std::abs(was));
    ++checked;
  }
  EXPECT_GT(checked, 100U);
}

TEST(Preprocessors, TheEqualisedHistogramIsFlat) {
  PreprocessFixture fixture;
  const auto done = run(make("histogram-normalise"), fixture.scene(), fixture);
  ASSERT_TRUE(done);
  std::vector<double> tenths(10);
  for (const float grey : done->left.grey)
    tenths[std::min<std::size_t>(9, static_cast<std::size_t>(grey / 25.5F))] += 1;
  for (const double n : tenths) EXPECT_NEAR(n / static_cast<double>(done->left.grey.size()), 0.1, 0.005);
}

TEST(Preprocessors, WhatOnlyOneViewSeesHasNoSayInTheTransfer) {
  BumpScene scene = kSkinScene;
  scene.noise = 0.3;
  scene.right_gain = 1;
  PreprocessFixture fixture;
  RectifiedPair pair = scene.render(&fixture.output);
  expose(pair, {0.7, 30, 1.4});
  const auto clean = run(make("histogram-match"), pair, fixture);
  ASSERT_TRUE(clean);
  // A white wall in what is marked as not seen, and a black one outside of the face's region.
  pair.region.assign(pair.left.grey.size(), 1);
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x) {
      const auto k = static_cast<std::size_t>(y * pair.width_px + x);
      if (x >= pair.width_px - 30) {
        pair.right.grey[k] = 255;
        pair.right.valid[k] = 0;
      }
      if (y < 40) {
        pair.left.grey[k] = 0;
        pair.region[k] = 0;
      }
    }
  const auto done = run(make("histogram-match"), pair, fixture);
  ASSERT_TRUE(done);
  double worst = 0;
  for (int y = 50; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px - 30; ++x) {
      const auto k = static_cast<std::size_t>(y * pair.width_px + x);
      worst = std::max(worst, static_cast<double>(std::abs(done->right.grey[k] - clean->right.grey[k])));
    }
  EXPECT_LT(worst, 12);  // of 255: the histograms of two thirds of the scene instead of all of it
}

// The curve against its slow twin: sorting.
TEST(GreyHistogram, AgreesWithCounting) {
  PreprocessFixture fixture;
  const RectifiedPair pair = fixture.scene();
  const auto all = [](int, int) { return true; };
  const GreyHistogram histogram =
      GreyHistogram::of(pair.left.grey, pair.width_px, pair.height_px, all, fixture.pool);
  std::vector<float> sorted(pair.left.grey.begin(), pair.left.grey.end());
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(histogram.count(), sorted.size());
  for (double grey = 1; grey < 254; grey += 3.7) {
    const auto below =
        std::lower_bound(sorted.begin(), sorted.end(), static_cast<float>(grey)) - sorted.begin();
    EXPECT_NEAR(histogram.share_below(grey), static_cast<double>(below) / static_cast<double>(sorted.size()),
                0.002)
        << grey;
  }
  for (double share = 0.01; share < 1; share += 0.07)
    EXPECT_NEAR(
        histogram.grey_at(share),
        static_cast<double>(sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size()))]),
        0.6)
        << share;
}

}  // namespace
}  // namespace relievo::pipeline
