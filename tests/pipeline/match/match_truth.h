// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the matches of a matcher are from the truth of a bump scene. Shared by the matchers' tests.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "pipeline/base/kinds.h"
#include "tests/support/bump_scene.h"
#include "tests/support/stage_fixture.h"

namespace relievo::test {

struct MatchErrors {
  double covered = 0;           // share of the judged keypoints that have a match
  double wrong = 0;             // share of the matches further than a pixel from the truth
  double rms_px = 0;            // of those that are not wrong
  double within_sigma = 0;      // of those that are not wrong
  double within_two_sigma = 0;  // 1.96
  double mean_cost = 0;
};

inline MatchErrors judge(const BumpScene& scene, const pipeline::Keypoints& keypoints,
                         const pipeline::MatchSet& set) {
  MatchErrors errors;
  double judged = 0;
  for (const pipeline::Keypoint& k : keypoints.points) judged += scene.judged(k.at_px.x, k.at_px.y) ? 1 : 0;
  double n = 0;
  double right = 0;
  for (const pipeline::Match& m : set.matches) {
    if (!scene.judged(m.left_px.x, m.left_px.y)) continue;
    const double e =
        std::abs(static_cast<double>(m.disparity_px) - scene.disparity(m.left_px.x, m.left_px.y));
    ++n;
    errors.mean_cost += static_cast<double>(m.cost);
    EXPECT_GE(m.cost, 0);
    EXPECT_LE(m.cost, 1);
    EXPECT_GT(m.sigma_px, 0);
    if (!(e <= 1)) continue;
    ++right;
    errors.rms_px += e * e;
    errors.within_sigma += e <= static_cast<double>(m.sigma_px) ? 1 : 0;
    errors.within_two_sigma += e <= 1.96 * static_cast<double>(m.sigma_px) ? 1 : 0;
  }
  errors.covered = n / std::max(1.0, judged);
  errors.wrong = (n - right) / std::max(1.0, n);
  errors.rms_px = std::sqrt(errors.rms_px / std::max(1.0, right));
  errors.within_sigma /= std::max(1.0, right);
  errors.within_two_sigma /= std::max(1.0, right);
  errors.mean_cost /= std::max(1.0, n);
  return errors;
}

// Colours of a scene: three textures on one surface, so that each channel says something of its own.
inline void paint(const BumpScene& scene, pipeline::RectifiedPair& pair) {
  std::vector<std::byte> block(std::size_t{24} << 20);
  for (std::uint32_t c = 0; c < 3; ++c) {
    Arena memory(block);
    BumpScene own = scene;
    own.seed = scene.seed + 7 * c + 7;
    const pipeline::RectifiedPair channel = own.render(&memory);
    for (std::size_t k = 0; k < channel.left.grey.size(); ++k) {
      pair.left.rgb[3 * k + c] =
          static_cast<std::uint8_t>(std::clamp(channel.left.grey[k] + 0.5F, 0.0F, 255.0F));
      pair.right.rgb[3 * k + c] =
          static_cast<std::uint8_t>(std::clamp(channel.right.grey[k] + 0.5F, 0.0F, 255.0F));
    }
  }
}

// Anywhere, also between pixels, in no order.
inline pipeline::Keypoints scattered(const pipeline::RectifiedPair& pair, int count, std::uint32_t seed,
                                     std::pmr::memory_resource* memory) {
  pipeline::Keypoints keypoints(memory);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int k = 0; k < count; ++k)
    keypoints.points.push_back({{unit(random) * static_cast<float>(pair.width_px - 1),
                                 unit(random) * static_cast<float>(pair.height_px - 1)},
                                1});
  return keypoints;
}

struct MatchTrial {
  BumpScene scene;
  int scattered = 0;  // this many keypoints anywhere; 0: a lattice of two pixels
  bool colours = false;
};

inline MatchErrors measure(const pipeline::Matcher& matcher, const MatchTrial& trial) {
  StageFixture fixture(std::size_t{16} << 20, std::size_t{96} << 20, 2);
  pipeline::RectifiedPair pair = trial.scene.render(&fixture.output);
  if (trial.colours) paint(trial.scene, pair);
  const pipeline::Keypoints keypoints = trial.scattered > 0
                                            ? scattered(pair, trial.scattered, 99, &fixture.output)
                                            : lattice(pair, 2, &fixture.output);
  const auto matches = pipeline::run_stage(
      fixture.context, [&](pipeline::StageContext& c) { return matcher(pair, keypoints, c); });
  EXPECT_TRUE(matches);
  if (!matches) return {};
  EXPECT_EQ(matches->lattice_step_px, keypoints.lattice_step_px);
  const MatchErrors errors = judge(trial.scene, keypoints, *matches);
  if (testing::Test::HasFailure() || std::getenv("RELIEVO_TEST_FIGURES") != nullptr)
    std::printf("covered %.4f wrong %.4f rms %.4f px, within sigma %.3f, 1.96 sigma %.3f, cost %.3f\n",
                errors.covered, errors.wrong, errors.rms_px, errors.within_sigma, errors.within_two_sigma,
                errors.mean_cost);
  return errors;
}

// `Concrete`: a matcher with its options.
template <typename Concrete>
MatchErrors measure(const Concrete& matcher, const MatchTrial& trial) {
  return measure(pipeline::Matcher(std::bind_front(&Concrete::match, matcher)), trial);
}

}  // namespace relievo::test
