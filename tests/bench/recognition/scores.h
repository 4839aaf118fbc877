// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a table of comparisons says: how often the nearest enrolled person is the right one, and how well one
// threshold tells same from different. Names and definitions as ISO/IEC 19795-1: a probe that could not be
// compared counts against the system (rank 1 missed, falsely rejected), never for it. Thread: any.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace relievo::bench {

struct Score {
  int gallery = 0, probe_person = 0, probe = 0;
  std::optional<double> rms_mm;  // none: could not be compared
  double shared = 0;
  bool same() const { return gallery == probe_person; }
};

struct ErrorRates {
  double threshold_mm = 0;
  double false_match = 0;      // of different persons, share at or below the threshold
  double false_non_match = 0;  // of the same person, share above it
};

struct Verdict {
  int probes = 0, right_first = 0;  // rank 1
  int same = 0, different = 0;      // comparisons
  int not_compared = 0;
  double equal_error = 0, equal_error_mm = 0;
  double non_match_at_thousandth =
      0;               // false non-match where one in a thousand of the different match falsely
  double d_prime = 0;  // distance of the two means in deviations, of ln(rms)
  double greatest_same_mm = 0, least_different_mm = 0;
  double median_same_mm = 0, median_different_mm = 0;
};

Verdict judge(std::span<const Score> scores);
// At every score that occurs, rising.
std::vector<ErrorRates> error_rates(std::span<const Score> scores);

}  // namespace relievo::bench
