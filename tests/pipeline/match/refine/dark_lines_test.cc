// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Grooves under dark lines, and light that differs between the views, against scenes whose truth is known.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/match/refine/refined_matcher.h"
#include "tests/support/bump_scene.h"
#include "tests/support/stage_fixture.h"

namespace relievo::pipeline {
namespace {

using test::BumpScene;
using test::StageFixture;

struct Found {
  double depth = 0;     // of the groove, as a share of the truth's
  double within = 0;    // one sigma, of the matches within 12 px of it
  double sigma_px = 0;  // median
};

// `shine`: the right view is brighter by up to this share, in patches of ten pixels.
Found find(const BumpScene& scene, double shine = 0) {
  StageFixture fixture(std::size_t{64} << 20, std::size_t{256} << 20, 2);
  RectifiedPair pair = scene.render(&fixture.output);
  for (int y = 0; y < pair.height_px; ++y)
    for (int x = 0; x < pair.width_px; ++x)
      pair.right.grey[pair.index(x, y)] *=
          static_cast<float>(1 + shine * std::sin(0.3 * x) * std::sin(0.3 * y));
  const Keypoints keypoints = test::lattice(pair, 2, &fixture.output);
  const auto matches = run_stage(
      fixture.context, [&](StageContext& c) { return RefinedMatcher({}).match(pair, keypoints, c); });
  Found found;
  EXPECT_TRUE(matches);
  if (!matches) return found;
  double bottom = 0, bottoms = 0, sides = 0, beside = 0, near = 0;
  std::vector<double> sigmas;
  for (const Match& m : matches->matches) {
    const double off = m.left_px.y - 0.75 * scene.height_px;
    if (!scene.judged(m.left_px.x, m.left_px.y) || std::abs(off) > 12) continue;
    const double e = m.disparity_px - scene.disparity(m.left_px.x, m.left_px.y);
    ++near;
    found.within += std::abs(e) <= double(m.sigma_px) ? 1 : 0;
    sigmas.push_back(m.sigma_px);
    if (std::abs(off) < 1) bottom += e, ++bottoms;
    if (std::abs(off) > 10) sides += e, ++beside;
  }
  found.within /= near;
  found.sigma_px = median(sigmas);
  found.depth = 1 - (bottom / bottoms - sides / beside) / scene.groove_px;
  return found;
}

// As the line between closed lips: 1 mm deep on the rig of the rendered faces at half the size, and as wide.
TEST(DarkLines, AGrooveUnderALineKeepsItsDepth) {
  const BumpScene groove{
      .groove_px = 0.65, .groove_radius_px = 4, .groove_dark = 0.5, .contrast = 8, .noise = 1.5, .seed = 21};
  const Found found = find(groove);
  EXPECT_GT(found.depth, 0.6);
  EXPECT_LT(found.depth, 1.2);
  EXPECT_GT(found.within, 0.55);
  RecordProperty("depth", std::to_string(found.depth));
  RecordProperty("within", std::to_string(found.within));
}

// The line alone makes no groove.
TEST(DarkLines, ALineThatIsPaintedStaysFlat) {
  BumpScene painted{.groove_dark = 0.5, .contrast = 6, .noise = 1.5, .seed = 22};
  StageFixture fixture(std::size_t{64} << 20, std::size_t{256} << 20, 2);
  const RectifiedPair pair = painted.render(&fixture.output);
  const Keypoints keypoints = test::lattice(pair, 2, &fixture.output);
  const auto matches = run_stage(
      fixture.context, [&](StageContext& c) { return RefinedMatcher({}).match(pair, keypoints, c); });
  ASSERT_TRUE(matches);
  double sum = 0, squares = 0, n = 0;
  for (const Match& m : matches->matches) {
    if (!painted.judged(m.left_px.x, m.left_px.y) || std::abs(m.left_px.y - 0.75 * painted.height_px) > 3)
      continue;
    const double e = m.disparity_px - painted.disparity(m.left_px.x, m.left_px.y);
    sum += e, squares += e * e, ++n;
  }
  EXPECT_LT(std::abs(sum / n), 0.05);
  EXPECT_LT(std::sqrt(squares / n), 0.2);
}

TEST(DarkLines, WhereTheViewsAreNotLitAlikeSigmaGrows) {
  const BumpScene scene{.groove_px = 0.1, .contrast = 12, .noise = 1, .seed = 23};
  const Found even = find(scene);
  const Found shining = find(scene, 0.03);
  EXPECT_GT(shining.sigma_px, 1.5 * even.sigma_px);
  EXPECT_GT(shining.within, 0.6);
  RecordProperty("within", std::to_string(shining.within));
  RecordProperty("sigma_even", std::to_string(even.sigma_px));
  RecordProperty("sigma_shining", std::to_string(shining.sigma_px));
}

}  // namespace
}  // namespace relievo::pipeline
