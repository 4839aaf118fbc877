// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/scores.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo::bench {
namespace {

Score score(int gallery, int person, int probe, std::optional<double> mm) {
  return {gallery, person, probe, mm, 1};
}

TEST(RecognitionScores, TheNearestCountsAndWhoCannotBeComparedIsMissed) {
  const std::vector<Score> scores{
      score(0, 0, 0, 0.1),          score(1, 0, 0, 0.4),           // right
      score(0, 1, 0, 0.2),          score(1, 1, 0, 0.3),           // wrong
      score(0, 1, 1, std::nullopt), score(1, 1, 1, 0.3),           // right: the other could not be compared
      score(0, 0, 1, 0.5),          score(1, 0, 1, std::nullopt),  // right
      score(0, 0, 2, std::nullopt), score(1, 0, 2, std::nullopt),  // missed
  };
  const Verdict v = judge(scores);
  EXPECT_EQ(v.probes, 5);
  EXPECT_EQ(v.right_first, 3);
  EXPECT_EQ(v.same, 5);
  EXPECT_EQ(v.different, 5);
  EXPECT_EQ(v.not_compared, 4);
}

TEST(RecognitionScores, RatesAreSharesOfAllComparisons) {
  // Same: 0.1, 0.2, 0.3 and one that failed. Different: 0.25, 0.5, 0.6, 0.7.
  const std::vector<Score> scores{score(0, 0, 0, 0.1),          score(0, 0, 1, 0.2),  score(0, 0, 2, 0.3),
                                  score(0, 0, 3, std::nullopt), score(1, 0, 0, 0.25), score(1, 0, 1, 0.5),
                                  score(1, 0, 2, 0.6),          score(1, 0, 3, 0.7)};
  const auto rates = error_rates(scores);
  ASSERT_EQ(rates.size(), 7u);
  EXPECT_DOUBLE_EQ(rates[1].threshold_mm, 0.2);
  EXPECT_DOUBLE_EQ(rates[1].false_match, 0);
  EXPECT_DOUBLE_EQ(rates[1].false_non_match, 0.5) << "0.3 and the one that failed";
  EXPECT_DOUBLE_EQ(rates[3].false_match, 0.25);
  EXPECT_DOUBLE_EQ(rates[3].false_non_match, 0.25);
  const Verdict v = judge(scores);
  EXPECT_DOUBLE_EQ(v.equal_error, 0.25);
  EXPECT_DOUBLE_EQ(v.equal_error_mm, 0.3);
  EXPECT_DOUBLE_EQ(v.non_match_at_thousandth, 0.5) << "no different person below 0.25";
  EXPECT_DOUBLE_EQ(v.greatest_same_mm, 0.3);
  EXPECT_DOUBLE_EQ(v.least_different_mm, 0.25);
}

TEST(RecognitionScores, DPrimeIsTheDistanceOfTheMeansInDeviations) {
  std::vector<Score> scores;
  for (const double u : {-1.0, 1.0}) {
    scores.push_back(score(0, 0, u > 0 ? 1 : 0, std::exp(u)));      // mean 0, deviation 1 of the logarithm
    scores.push_back(score(1, 0, u > 0 ? 1 : 0, std::exp(6 + u)));  // mean 6
  }
  EXPECT_NEAR(judge(scores).d_prime, 6, 1e-9);
}

}  // namespace
}  // namespace relievo::bench
