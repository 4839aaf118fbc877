// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of every matcher in the table, whatever it does inside.
#include <gtest/gtest.h>

#include <vector>

#include "pipeline/algorithms.h"
#include "tests/pipeline/match/match_truth.h"
#include "tests/support/names_of.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::StageFixture;

// What is read from a file has tests of its own.
std::vector<std::string> searching_matchers() {
  std::vector<std::string> names = test::names_of("matcher");
  std::erase(names, "file-matches");
  return names;
}

// The figures that a matcher keeps, as pipeline/FIGURES.md has them: on the bump of radius 40 px and height 5
// px below.
struct Stated {
  std::string name;
  double rms_px, covered;
};
Stated stated(const std::string& name) {
  for (const Stated& figures :
       {Stated{"refined", 0.04, 0.99}, Stated{"ssd", 0.20, 0.99}, Stated{"zmncc", 0.20, 0.99},
        Stated{"wavelet", 0.10, 0.99}, Stated{"sgm", 0.22, 0.99}, Stated{"opencv-sgbm", 0.14, 0.85}})
    if (figures.name == name) return figures;
  ADD_FAILURE() << name << " states no figure";
  return {name, 0, 1};
}

class Matchers : public testing::TestWithParam<std::string> {
 protected:
  Matcher matcher() const { return test::made(&Algorithms::matcher, "matcher", GetParam()); }
  BumpScene scene{.width_px = 192, .height_px = 128, .base_px = 20, .bump_px = 5, .bump_radius_px = 40};
};

TEST_P(Matchers, FindTheSurfaceOnALatticeAndAnywhere) {
  for (const int scattered : {0, 400}) {
    const test::MatchErrors errors = test::measure(matcher(), {.scene = scene, .scattered = scattered});
    EXPECT_GT(errors.covered, stated(GetParam()).covered) << scattered;
    EXPECT_LT(errors.rms_px, stated(GetParam()).rms_px) << scattered;
    EXPECT_LT(errors.wrong, 0.001) << scattered;
    EXPECT_LT(errors.mean_cost, 0.1) << scattered;
  }
}

TEST_P(Matchers, KeepTheOrderOfTheKeypointsAndRejectNothing) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{64} << 20);
  const RectifiedPair pair = scene.render(&fixture.output);
  const Keypoints keypoints = test::lattice(pair, 2, &fixture.output);
  const auto matches =
      run_stage(fixture.context, [&](StageContext& c) { return matcher()(pair, keypoints, c); });
  ASSERT_TRUE(matches);
  AlgorithmSet set;
  ASSERT_TRUE(set.set("matcher", GetParam()));
  EXPECT_EQ(check_neighbours(set).has_value(), matches->lattice_step_px > 0) << "as the table says";
  std::size_t next = 0;
  for (const Match& m : matches->matches) {
    EXPECT_EQ(m.rejected_by, 0);
    while (next < keypoints.points.size() &&
           (keypoints.points[next].at_px.x != m.left_px.x || keypoints.points[next].at_px.y != m.left_px.y))
      ++next;
    ASSERT_LT(next, keypoints.points.size());
  }
}

TEST_P(Matchers, GiveTheSameBytesForAnyNumberOfThreads) {
  std::vector<Match> first;
  for (const int threads : {1, 2, 3, 2}) {
    StageFixture fixture(std::size_t{16} << 20, std::size_t{64} << 20, threads);
    const RectifiedPair pair = scene.render(&fixture.output);
    const Keypoints keypoints = test::lattice(pair, 2, &fixture.output);
    const auto matches =
        run_stage(fixture.context, [&](StageContext& c) { return matcher()(pair, keypoints, c); });
    ASSERT_TRUE(matches);
    if (first.empty()) first.assign(matches->matches.begin(), matches->matches.end());
    ASSERT_EQ(first.size(), matches->matches.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      ASSERT_EQ(first[k].disparity_px, matches->matches[k].disparity_px)
          << threads << " threads, match " << k;
      ASSERT_EQ(first[k].sigma_px, matches->matches[k].sigma_px);
      ASSERT_EQ(first[k].cost, matches->matches[k].cost);
    }
  }
}

TEST_P(Matchers, RefuseAPairWithoutPixelsAndKeypointsThatAreNone) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{64} << 20);
  const RectifiedPair nothing(&fixture.output);
  const Keypoints none(&fixture.output);
  auto matches = run_stage(fixture.context, [&](StageContext& c) { return matcher()(nothing, none, c); });
  ASSERT_FALSE(matches);
  EXPECT_EQ(matches.error().code, Errc::InvalidInput);
  const RectifiedPair pair = scene.render(&fixture.output);
  matches = run_stage(fixture.context, [&](StageContext& c) { return matcher()(pair, none, c); });
  ASSERT_FALSE(matches);
  EXPECT_EQ(matches.error().code, Errc::TooFewMatches);
}

TEST_P(Matchers, FindNothingOnAPlainWall) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{64} << 20);
  scene.contrast = 0;
  scene.noise = 0;
  const RectifiedPair pair = scene.render(&fixture.output);
  const Keypoints keypoints = test::lattice(pair, 2, &fixture.output);
  const auto matches =
      run_stage(fixture.context, [&](StageContext& c) { return matcher()(pair, keypoints, c); });
  ASSERT_FALSE(matches);
  EXPECT_EQ(matches.error().code, Errc::TooFewMatches);
}

TEST_P(Matchers, EveryArenaTooSmallSaysSo) {
  std::vector<std::byte> block(std::size_t{8} << 20);
  Arena memory(block);
  const RectifiedPair pair = scene.render(&memory);
  const Keypoints keypoints = test::lattice(pair, 2, &memory);
  int refusals = 0;
  bool succeeded = false;
  for (std::size_t size = 4096; size < (std::size_t{64} << 20) && !succeeded; size += size / 2) {
    StageFixture fixture(size, size);
    const auto matches =
        run_stage(fixture.context, [&](StageContext& c) { return matcher()(pair, keypoints, c); });
    succeeded = matches.has_value();
    if (succeeded) break;
    EXPECT_EQ(matches.error().code, Errc::OutOfMemory) << size;
    ++refusals;
  }
  EXPECT_TRUE(succeeded);
  EXPECT_GT(refusals, 5);
}

TEST_P(Matchers, StopWhenAsked) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{64} << 20);
  const RectifiedPair pair = scene.render(&fixture.output);
  const Keypoints keypoints = test::lattice(pair, 2, &fixture.output);
  fixture.cancelled = true;
  // Not through run_stage, which would not even begin.
  const auto matches = matcher()(pair, keypoints, fixture.context);
  ASSERT_FALSE(matches);
  EXPECT_EQ(matches.error().code, Errc::Cancelled);
}

INSTANTIATE_TEST_SUITE_P(All, Matchers, testing::ValuesIn(searching_matchers()),
                         [](const auto& chosen) { return test::test_name(chosen.param); });

}  // namespace
}  // namespace relievo::pipeline
