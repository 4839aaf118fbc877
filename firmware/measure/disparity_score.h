// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a disparity map is from the truth, in the figures of Scharstein and Szeliski (2002): a pixel is bad
// where it is off by more than a limit, or where the map has none though the truth is known. Pixels; shares
// of 1. Thread: any. Errors: none; the sizes of map and truth are the caller's promise.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/measure/disparity_truth.h"

namespace relievo::firmware::compare {

// Signed errors in bins from -kReachPx to kReachPx; the first and last hold all beyond.
struct ErrorHistogram {
  static constexpr int kBins = 81;
  static constexpr double kReachPx = 4;
  std::array<std::size_t, kBins> counts{};
};

struct DisparityScore {
  std::size_t judged = 0;                                     // pixels whose truth is known
  std::size_t given = 0;                                      // of these, with a disparity
  double density = 0;                                         // given / judged
  double bad_half = 0, bad_1 = 0, bad_2 = 0, bad_4 = 0;       // of the judged; a hole is bad
  double bad_limit = 0;                                       // the same with the limit asked for
  double bad_given = 0;                                       // of the given, with the limit asked for
  std::size_t seen = 0;                                       // judged pixels that both views see
  double bad_seen = 0;                                        // of these, with the limit; a hole is bad
  double mean_px = 0, rms_px = 0, median_px = 0, p95_px = 0;  // of the absolute error of the given
  double bias_px = 0;  // mean signed error of the given that are within the limit
  ErrorHistogram histogram;
};

DisparityScore score(const DisparityMap& map, const DisparityTruth& truth, double limit_px);

// Two maps where both give a disparity and the truth is known: share of bad ones of each.
struct SharedScore {
  std::size_t shared = 0;
  double bad_one = 0, bad_other = 0;
  double median_one_px = 0, median_other_px = 0;
};
SharedScore score_shared(const DisparityMap& one, const DisparityMap& other, const DisparityTruth& truth,
                         double limit_px);

}  // namespace relievo::firmware::compare
