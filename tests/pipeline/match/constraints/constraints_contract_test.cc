// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of every constraint in the table, and what the ones that look at order, at the way back and at
// the others' disparities are for: errors put into a true set.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "pipeline/algorithms.h"
#include "tests/support/bump_scene.h"
#include "tests/support/names_of.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::StageFixture;

MatchConstraint constraint(const std::string& name, const test::Settings& settings = {}) {
  return test::made(&Algorithms::constraints, "constraints", name, settings).front();
}

// True matches of the bump scene with a little noise; every `wrong_every`-th is moved by 6 to 14 pixels.
struct Planted {
  Planted(const BumpScene& from, int wrong_every, int step, std::uint32_t seed = 1)
      : scene(from),
        fixture(std::size_t{6} << 20, std::size_t{16} << 20),
        pair(scene.render(&fixture.output)) {
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0, 0.1F);
    std::uniform_real_distribution<float> off(6, 14);
    int count = 0;
    for (const Keypoint& k : test::lattice(pair, step, &fixture.output).points) {
      if (!scene.judged(k.at_px.x, k.at_px.y)) continue;
      const bool spoil = wrong_every > 0 && ++count % wrong_every == 0;
      const auto d = static_cast<float>(scene.disparity(k.at_px.x, k.at_px.y)) + noise(random);
      matches.push_back({k.at_px,
                         spoil ? d + (count % (2 * wrong_every) == 0 ? off(random) : -off(random)) : d, 0.1F,
                         0.1F, 0});
      wrong.push_back(spoil);
    }
  }
  // Shares of the wrong and of the right ones that were rejected.
  std::pair<double, double> rejected() const {
    double bad = 0, bad_out = 0, good = 0, good_out = 0;
    for (std::size_t k = 0; k < matches.size(); ++k) {
      (wrong[k] ? bad : good) += 1;
      if (matches[k].rejected_by != 0) (wrong[k] ? bad_out : good_out) += 1;
    }
    return {bad_out / std::max(1.0, bad), good_out / std::max(1.0, good)};
  }
  BumpScene scene;
  StageFixture fixture;
  RectifiedPair pair;
  std::vector<Match> matches;
  std::vector<bool> wrong;
};

class MatchConstraints : public testing::TestWithParam<std::string> {};

TEST_P(MatchConstraints, LeaveATrueSurfaceAlone) {
  Planted planted({.width_px = 200, .height_px = 140}, 0, 2);
  constraint(GetParam())(planted.pair, planted.matches, 2, 4, planted.fixture.context);
  EXPECT_LT(planted.rejected().second, 0.02);
}

TEST_P(MatchConstraints, SetOnlyTheirBitAndOnlyOnAcceptedMatches) {
  Planted planted({.width_px = 200, .height_px = 140}, 7, 2);
  for (std::size_t k = 0; k < planted.matches.size(); k += 5) planted.matches[k].rejected_by = 1;
  const std::vector<Match> before = planted.matches;
  constraint(GetParam())(planted.pair, planted.matches, 2, 4, planted.fixture.context);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const Match& m = planted.matches[k];
    EXPECT_TRUE(before[k].rejected_by == 1 ? m.rejected_by == 1 : m.rejected_by == 0 || m.rejected_by == 4);
    EXPECT_EQ(m.disparity_px, before[k].disparity_px);
  }
}

TEST_P(MatchConstraints, JudgeAlikeForAnyNumberOfThreadsAndScattered) {
  Planted planted({.width_px = 160, .height_px = 110}, 7, 2);
  const std::vector<Match> before = planted.matches;
  for (const int step : {2, 0}) {
    std::vector<Match> first;
    for (const int threads : {1, 2, 3}) {
      planted.matches = before;
      StageFixture fixture(1 << 20, std::size_t{32} << 20, threads);
      constraint(GetParam())(planted.pair, planted.matches, step, 4, fixture.context);
      if (first.empty()) first = planted.matches;
      for (std::size_t k = 0; k < first.size(); ++k)
        ASSERT_EQ(first[k].rejected_by, planted.matches[k].rejected_by);
    }
  }
}

TEST_P(MatchConstraints, BearNothingAndTooLittleMemory) {
  Planted planted({.width_px = 160, .height_px = 110}, 7, 2);
  constraint(GetParam())(planted.pair, {}, 2, 4, planted.fixture.context);
  for (std::size_t size = 1024; size < (std::size_t{32} << 20); size *= 4) {
    StageFixture fixture(1024, size, 2);
    const auto judged = run_stage(fixture.context, [&](StageContext& c) -> Result<void> {
      constraint(GetParam())(planted.pair, planted.matches, 2, 4, c);
      return {};
    });
    if (!judged) {
      EXPECT_EQ(judged.error().code, Errc::OutOfMemory);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MatchConstraints, testing::ValuesIn(test::names_of("constraints")),
                         [](const auto& chosen) { return test::test_name(chosen.param); });

// What one view shows elsewhere, ZMNCC finds a place for all the same. Its own threshold has spared the
// default limit any work; a limit of its own takes what was found there, and hardly anything else.
TEST(SimilarityConstraint, AfterZmnccOnlyALimitBelowItsThresholdSaysSomething) {
  const BumpScene scene{.width_px = 260, .height_px = 180};
  StageFixture fixture(std::size_t{16} << 20, std::size_t{64} << 20);
  RectifiedPair pair(&fixture.output);
  pair = scene.render(&fixture.output);
  const RectifiedPair other =
      BumpScene{.width_px = 260, .height_px = 180, .seed = 99}.render(&fixture.output);
  for (std::size_t k = 0; k < pair.right.grey.size() / 2; ++k)
    pair.right.grey[k] = other.right.grey[k];  // its upper half
  AlgorithmSet set;
  ASSERT_TRUE(set.set("matcher", "zmncc"));
  const auto made = make_algorithms(set);
  auto found = run_stage(fixture.context, [&](StageContext& c) {
    return made->matcher(pair, test::lattice(pair, 4, &fixture.output), c);
  });
  ASSERT_TRUE(found);
  std::vector<Match> matches(found->matches.begin(), found->matches.end());
  const auto reject = [&](const char* limit) {
    std::vector<Match> judged = matches;
    constraint("similarity", {{"similarity.max_cost", limit}})(pair, judged, 4, 4, fixture.context);
    double bad = 0, bad_out = 0, good = 0, good_out = 0;
    for (const Match& m : judged) {
      const bool in_both = std::abs(m.left_px.y - 90) <= 13;  // the window lies across the seam
      if (in_both || !scene.judged(m.left_px.x, m.left_px.y)) continue;
      const bool wrong =
          std::abs(static_cast<double>(m.disparity_px) - scene.disparity(m.left_px.x, m.left_px.y)) > 1;
      (wrong ? bad : good) += 1;
      if (m.rejected_by != 0) (wrong ? bad_out : good_out) += 1;
    }
    EXPECT_GT(bad, 50);
    EXPECT_GT(good, 300);
    return std::pair(bad_out / bad, good_out / good);
  };
  const auto [bad_by_default, good_by_default] = reject("0.95");
  EXPECT_EQ(bad_by_default + good_by_default, 0);
  const auto [bad_taken, good_taken] = reject("0.4");
  EXPECT_GT(bad_taken, 0.5);
  EXPECT_LT(good_taken, 0.05);
}

TEST(OrderingConstraint, TheLargestOrderedSetStays) {
  StageFixture fixture(1024, 1 << 20, 1);
  RectifiedPair pair(std::pmr::get_default_resource());
  pair.width_px = 200;
  pair.height_px = 40;
  // On the right row: 10 20 55 30 40 5 50; 55 and 5 are out of order.
  const float right[] = {10, 20, 55, 30, 40, 5, 50};
  std::vector<Match> matches;
  for (int k = 0; k < 7; ++k)
    matches.push_back(
        {{static_cast<float>(60 + 10 * k), 4}, static_cast<float>(60 + 10 * k) - right[k], 0, 0.1F, 0});
  matches.push_back({{65, 5}, 0, 0, 0.1F, 0});  // another row
  constraint("ordering", {{"ordering.slack", "0"}})(pair, matches, 0, 2, fixture.context);
  for (std::size_t k = 0; k < matches.size(); ++k)
    EXPECT_EQ(matches[k].rejected_by, k == 2 || k == 5 ? 2 : 0) << k;
}

// The slow twin: no set of a row in order is larger (all subsets tried).
TEST(OrderingConstraint, NoLargerOrderedSetExists) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 40);
  RectifiedPair pair(std::pmr::get_default_resource());
  for (int trial = 0; trial < 50; ++trial) {
    StageFixture fixture(1024, 1 << 16, 1);
    std::vector<Match> matches;
    for (int k = 0; k < 12; ++k)
      matches.push_back({{static_cast<float>(50 + 3 * k), 4}, unit(random), 0, 0.1F, 0});
    constraint("ordering", {{"ordering.slack", "0"}})(pair, matches, 0, 2, fixture.context);
    int kept = 0;
    float last = -1e9F;
    for (const Match& m : matches) {
      if (m.rejected_by != 0) continue;
      ++kept;
      EXPECT_GE(m.left_px.x - m.disparity_px, last);
      last = m.left_px.x - m.disparity_px;
    }
    int most = 0;
    for (int set = 0; set < 1 << 12; ++set) {
      float before = -1e9F;
      int size = 0;
      for (int k = 0; k < 12 && size >= 0; ++k) {
        if ((set >> k & 1) == 0) continue;
        const float at = matches[static_cast<std::size_t>(k)].left_px.x -
                         matches[static_cast<std::size_t>(k)].disparity_px;
        size = at >= before ? size + 1 : -100;
        before = at;
      }
      most = std::max(most, size);
    }
    EXPECT_EQ(kept, most);
  }
}

TEST(LeftRightConstraint, TakesWhatIsNotFoundFromTheOtherSide) {
  for (const int step : {2, 5}) {
    Planted planted({.width_px = 240, .height_px = 160}, 9, step);
    constraint("left-right")(planted.pair, planted.matches, step, 4, planted.fixture.context);
    EXPECT_GT(planted.rejected().first, 0.95);
    EXPECT_LT(planted.rejected().second, 0.01);
  }
}

TEST(LeftRightConstraint, CatchesAPixelBetweenPixels) {
  Planted planted({.width_px = 200, .height_px = 140}, 0, 3);
  for (std::size_t k = 0; k < planted.matches.size(); k += 2) {
    planted.matches[k].disparity_px += 1.6F;
    planted.matches[k].left_px = {planted.matches[k].left_px.x + 0.25F, planted.matches[k].left_px.y + 0.5F};
    planted.wrong[k] = true;
  }
  constraint("left-right")(planted.pair, planted.matches, 0, 4, planted.fixture.context);
  EXPECT_GT(planted.rejected().first, 0.95);
  EXPECT_LT(planted.rejected().second, 0.01);
}

TEST(StatisticalConstraint, TakesWhatStandsOutFromItsNeighboursAndFromAll) {
  Planted near({.width_px = 240, .height_px = 160}, 9, 2);
  constraint("statistical", {{"statistical.global_sigmas", "0"}})(near.pair, near.matches, 2, 4,
                                                                  near.fixture.context);
  EXPECT_GT(near.rejected().first, 0.99);
  EXPECT_LT(near.rejected().second, 0.005);
  Planted all({.width_px = 240, .height_px = 160}, 9, 2);
  for (std::size_t k = 0; k < all.matches.size(); ++k)
    if (all.wrong[k]) all.matches[k].disparity_px += all.matches[k].disparity_px > 20 ? 60.0F : -60.0F;
  constraint("statistical", {{"statistical.local_sigmas", "0"}})(all.pair, all.matches, 2, 4,
                                                                 all.fixture.context);
  EXPECT_GT(all.rejected().first, 0.99);
  EXPECT_LT(all.rejected().second, 0.005);
}

}  // namespace
}  // namespace relievo::pipeline
