// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A match made by hand among a matcher's, on a scene whose truth is known: a right one mends a hole and a
// wrong patch, a wrong one does harm within its reach alone, and no filter takes it away.
#include "pipeline/match/hand/hand_matches.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "pipeline/match/window/window_correlation.h"
#include "pipeline/pipeline.h"
#include "tests/support/bump_scene.h"
#include "tests/support/names_of.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

constexpr int kStep = 2;
constexpr double kPatchPx = 14;  // radius of what is planted

class HandMatches : public testing::Test {
 protected:
  // What a good matcher would say: the truth, and its sigma.
  MatchSet true_matches(int step = kStep) {
    MatchSet set(&fixture.output);
    set.lattice_step_px = step;
    for (const Keypoint& k : test::lattice(pair, std::max(1, step), &fixture.output).points)
      set.matches.push_back({k.at_px, truth(k.at_px), 0.05F, 0.05F, 0});
    return set;
  }
  float truth(Vec2f at) const {
    return static_cast<float>(scene.disparity(static_cast<double>(at.x), static_cast<double>(at.y)));
  }
  double off(const Match& m) const {
    return std::abs(static_cast<double>(m.disparity_px - truth(m.left_px)));
  }
  static double from(const Match& m, Vec2f place) {
    return std::hypot(static_cast<double>(m.left_px.x - place.x), static_cast<double>(m.left_px.y - place.y));
  }
  Match by_hand(float error_px) const { return {place, truth(place) + error_px, 0, 0.3F, 0}; }
  Result<MatchSet> join(const MatchSet& matches, std::span<const Match> hand) {
    return join_by_hand(pair, matches, hand, fixture.context);
  }
  struct Patch {
    std::size_t known = 0, wrong = 0;  // of the places of the patch; wrong: by more than half a pixel
  };
  Patch patch_of(const MatchSet& set) const {
    Patch patch;
    for (const Match& m : set.matches)
      if (m.rejected_by == 0 && from(m, place) < kPatchPx) ++patch.known, patch.wrong += off(m) > 0.5 ? 1 : 0;
    return patch;
  }

  test::BumpScene scene;
  test::StageFixture fixture{std::size_t{48} << 20, std::size_t{96} << 20, 2};
  RectifiedPair pair = scene.render(&fixture.output);
  const Vec2f place{151.4F, 120.7F};  // on the bump's flank, between the nodes
};

TEST_F(HandMatches, ARightOneMendsAHole) {
  MatchSet matches = true_matches();
  const std::size_t whole = patch_of(matches).known;
  std::erase_if(matches.matches,
                [&](const Match& m) { return from(m, place) < kPatchPx && m.left_px.x > 150; });
  for (Match& m : matches.matches)  // the rest of it a rule has taken
    if (from(m, place) < kPatchPx) m.rejected_by = 2;
  ASSERT_EQ(patch_of(matches).known, 0U);
  const std::array hand{by_hand(0.1F)};
  const auto joined = join(matches, hand);
  ASSERT_TRUE(joined);
  EXPECT_GT(patch_of(*joined).known, whole * 95 / 100);
  EXPECT_EQ(patch_of(*joined).wrong, 0U);
  std::set<std::pair<float, float>> places;
  for (const Match& m : joined->matches)
    EXPECT_TRUE(places.insert({m.left_px.x, m.left_px.y}).second) << "one match a node";
}

TEST_F(HandMatches, ARightOneMendsAWrongPatch) {
  for (const float error : {-9.0F, -3.0F, 5.0F}) {
    MatchSet matches = true_matches();
    for (Match& m : matches.matches)
      if (from(m, place) < kPatchPx) m.disparity_px += error;
    const Patch planted = patch_of(matches);
    ASSERT_EQ(planted.wrong, planted.known);
    const std::array hand{by_hand(-0.1F)};
    const auto joined = join(matches, hand);
    ASSERT_TRUE(joined);
    EXPECT_EQ(joined->matches.size(), matches.matches.size());
    EXPECT_LT(patch_of(*joined).wrong, planted.known / 20) << error;
    for (std::size_t k = 0; k < matches.matches.size(); ++k)
      if (from(matches.matches[k], place) > kPatchPx + 2) {
        EXPECT_EQ(joined->matches[k].disparity_px, matches.matches[k].disparity_px)
            << "the surface around stays";
      }
  }
}

TEST_F(HandMatches, AWrongOneDoesHarmWithinItsReachAlone) {
  const double reach_px = kHandReachMm * pair.focal_px / pair.depth_mm(static_cast<double>(truth(place)));
  for (const float error : {-6.0F, 2.0F, 7.0F}) {
    const MatchSet matches = true_matches();
    const std::array hand{by_hand(error)};
    const auto joined = join(matches, hand);
    ASSERT_TRUE(joined);
    ASSERT_EQ(joined->matches.size(), matches.matches.size());
    for (std::size_t k = 0; k < matches.matches.size(); ++k) {
      const Match& m = joined->matches[k];
      // Nothing is dragged further than the hand went, nor at all where it cannot reach.
      EXPECT_LE(off(m), static_cast<double>(std::abs(error)) + 1.0);
      if (from(m, place) > std::min(reach_px, std::max(8.0, 3.0 * static_cast<double>(std::abs(error))))) {
        EXPECT_NEAR(m.disparity_px, matches.matches[k].disparity_px, 1e-4)
            << error << " at " << from(m, place);
      }
    }
  }
}

// Without texture nothing grows; the surface goes through the hand's place all the same, without a step.
TEST_F(HandMatches, WithoutTextureTheSurfaceBendsToIt) {
  scene.contrast = 0;
  pair = scene.render(&fixture.output);
  const MatchSet matches = true_matches();
  const std::array hand{by_hand(4)};
  const auto joined = join(matches, hand);
  ASSERT_TRUE(joined);
  double nearest = 0;
  for (std::size_t k = 0; k < matches.matches.size(); ++k) {
    const Match& m = joined->matches[k];
    const double moved = static_cast<double>(m.disparity_px - matches.matches[k].disparity_px);
    if (from(m, place) < 1) nearest = std::max(nearest, moved);
    { EXPECT_LE(moved, 4.8); }
    EXPECT_GE(moved, -0.8);
    if (from(m, place) > 12.5) {
      EXPECT_EQ(moved, 0);
    }
    if (from(m, place) > kStep && moved > 1) {
      EXPECT_GT(m.sigma_px, 0.05F) << "less certain than it was";
    }
  }
  EXPECT_NEAR(nearest, 4, 0.5);
}

// A window holds a node or two of such a lattice, or none: the place's own are no growth.
TEST_F(HandMatches, ACoarseLatticeBendsToItToo) {
  scene.contrast = 0;
  pair = scene.render(&fixture.output);
  for (const int coarse : {8, 16}) {
    const MatchSet matches = true_matches(coarse);
    const std::array hand{by_hand(4)};
    const auto joined = join(matches, hand);
    ASSERT_TRUE(joined);
    std::size_t around = 0;
    for (std::size_t k = 0; k < matches.matches.size(); ++k) {
      const Match& m = joined->matches[k];
      if (from(m, place) < coarse || from(m, place) > 1.6 * coarse) continue;
      EXPECT_GT(m.disparity_px - matches.matches[k].disparity_px, 0.5) << "no step beside it: " << coarse;
      ++around;
    }
    EXPECT_GT(around, 0U);
  }
}

TEST_F(HandMatches, AmongScatteredOnesItTakesThePlaceOfThoseItContradicts) {
  MatchSet matches = true_matches(0);
  std::erase_if(matches.matches, [&](const Match& m) {
    return static_cast<int>(m.left_px.x) % 5 != 0 || static_cast<int>(m.left_px.y) % 4 != 0;
  });
  std::size_t planted = 0;
  for (Match& m : matches.matches)
    if (from(m, place) < 4) m.disparity_px += 8, ++planted;
  ASSERT_GT(planted, 0U);
  const std::array hand{by_hand(0)};
  const auto joined = join(matches, hand);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->matches.size(), matches.matches.size() - planted + 1);
  for (const Match& m : joined->matches) EXPECT_LT(off(m), 0.01);
  EXPECT_EQ(joined->matches.back().left_px.x, place.x) << "where the hand put it, not on a lattice";
}

TEST_F(HandMatches, NoFilterTakesItAway) {
  const MatchSet matches = true_matches();
  const Vec2f alone{40.3F, 31.8F};
  std::vector<Match> hand{by_hand(7), {alone, truth(alone) - 5, 0, 0.3F, 0}};
  for (const std::string& filter : test::names_of("outliers"))
    for (const int step : {kStep, 0}) {
      AlgorithmSet set;
      ASSERT_TRUE(set.set("outliers", filter));
      const auto stages = Pipeline::make(set, {}, {}, Region::All);
      ASSERT_TRUE(stages) << stages.error().what.view();
      MatchSet given = true_matches(step);
      std::erase_if(given.matches, [&](const Match& m) { return from(m, alone) < 20; });
      const auto cloud = stages->reconstruct(pair, given, fixture.context, hand);
      ASSERT_TRUE(cloud);
      for (const Match& h : hand) {
        double best = 1e9;
        for (const CloudPoint& p : cloud->points)
          if (std::hypot(p.left_px.x - h.left_px.x, p.left_px.y - h.left_px.y) < 1.5F)
            best = std::min(best, std::abs(static_cast<double>(p.at_mm.z) -
                                           pair.depth_mm(static_cast<double>(h.disparity_px))));
        EXPECT_LT(best, 0.01) << filter << " step " << step;
      }
      EXPECT_EQ(cloud->lattice_step_px, step);
      fixture.output.reset();
      pair = scene.render(&fixture.output);
    }
}

TEST_F(HandMatches, OutsideThePicturesThereIsNone) {
  const MatchSet matches = true_matches();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Match bad :
       {Match{{-1, 20}, 5, 0, 1, 0}, Match{{20, 256}, 5, 0, 1, 0}, Match{{20, 20}, 21, 0, 1, 0},
        Match{{300, 20}, -30, 0, 1, 0}, Match{{nan, 20}, 5, 0, 1, 0}, Match{{20, 20}, nan, 0, 1, 0},
        Match{{20, 20}, 5, 0, 0, 0}}) {
    const std::array hand{by_hand(0), bad};
    const auto joined = join(matches, hand);
    ASSERT_FALSE(joined);
    EXPECT_EQ(joined.error().code, Errc::InvalidInput);
    EXPECT_EQ(joined.error().where(), "by hand 2");
  }
  fixture.cancelled = true;
  const std::array hand{by_hand(0)};
  MatchSet wrong = true_matches();
  for (Match& m : wrong.matches) m.disparity_px += 9;
  EXPECT_EQ(join(wrong, hand).error().code, Errc::Cancelled);
}

TEST_F(HandMatches, TheRowProposesThePartner) {
  const auto found = match_on_row(pair, place, 0, 60, 7);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->disparity_px, truth(place), 0.3);
  EXPECT_LT(found->cost, 0.1F);
  EXPECT_GT(found->sigma_px, 0);
  EXPECT_FALSE(match_on_row(pair, place, static_cast<double>(truth(place)) + 1, 60, 7).has_value() &&
               match_on_row(pair, place, static_cast<double>(truth(place)) + 1, 60, 7)->cost < 0.1F)
      << "what lies beyond the end is not found";
  EXPECT_FALSE(match_on_row(pair, {2, 2}, 0, 60, 7)) << "a window that leaves the picture";
  scene.contrast = scene.noise = 0;
  pair = scene.render(&fixture.output);
  EXPECT_FALSE(match_on_row(pair, place, 0, 60, 7)) << "plain";
}

}  // namespace
}  // namespace relievo::pipeline
