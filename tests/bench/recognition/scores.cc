// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/recognition/scores.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace relievo::bench {
namespace {

std::vector<double> distances(std::span<const Score> scores, bool same) {
  std::vector<double> out;
  for (const Score& s : scores)
    if (s.same() == same && s.rms_mm) out.push_back(*s.rms_mm);
  std::sort(out.begin(), out.end());
  return out;
}

int count(std::span<const Score> scores, bool same) {
  return static_cast<int>(
      std::count_if(scores.begin(), scores.end(), [&](const Score& s) { return s.same() == same; }));
}

// Logarithms: distances are positive, and their logarithms nearly normal.
std::pair<double, double> mean_and_variance(const std::vector<double>& values) {
  double mean = 0, variance = 0;
  for (const double v : values) mean += std::log(v) / static_cast<double>(values.size());
  for (const double v : values)
    variance += (std::log(v) - mean) * (std::log(v) - mean) / static_cast<double>(values.size());
  return {mean, variance};
}

double share_up_to(const std::vector<double>& sorted, double threshold, int of) {
  return of == 0 ? 0
                 : static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), threshold) -
                                       sorted.begin()) /
                       of;
}

int right_first(std::span<const Score> scores, int& probes) {
  std::map<std::pair<int, int>, const Score*> best;
  for (const Score& s : scores) {
    const Score*& b = best[{s.probe_person, s.probe}];
    if (b == nullptr || (s.rms_mm && (!b->rms_mm || *s.rms_mm < *b->rms_mm))) b = &s;
  }
  probes = static_cast<int>(best.size());
  return static_cast<int>(std::count_if(best.begin(), best.end(),
                                        [](const auto& b) { return b.second->rms_mm && b.second->same(); }));
}

}  // namespace

std::vector<ErrorRates> error_rates(std::span<const Score> scores) {
  const std::vector<double> same = distances(scores, true), different = distances(scores, false);
  const int all_same = count(scores, true), all_different = count(scores, false);
  std::vector<double> thresholds(same);
  thresholds.insert(thresholds.end(), different.begin(), different.end());
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  std::vector<ErrorRates> rates;
  rates.reserve(thresholds.size());
  for (const double t : thresholds)
    rates.push_back({t, share_up_to(different, t, all_different), 1 - share_up_to(same, t, all_same)});
  return rates;
}

Verdict judge(std::span<const Score> scores) {
  Verdict v;
  v.same = count(scores, true);
  v.different = count(scores, false);
  v.not_compared =
      static_cast<int>(std::count_if(scores.begin(), scores.end(), [](const Score& s) { return !s.rms_mm; }));
  v.right_first = right_first(scores, v.probes);
  double nearest = 2;
  v.non_match_at_thousandth = 1;
  for (const ErrorRates& r : error_rates(scores)) {
    const double gap = std::abs(r.false_match - r.false_non_match);
    if (gap < nearest) {
      nearest = gap;
      v.equal_error = 0.5 * (r.false_match + r.false_non_match);
      v.equal_error_mm = r.threshold_mm;
    }
    if (r.false_match <= 0.001)
      v.non_match_at_thousandth = std::min(v.non_match_at_thousandth, r.false_non_match);
  }
  const std::vector<double> same = distances(scores, true), different = distances(scores, false);
  if (same.empty() || different.empty()) return v;
  const auto [mean_same, variance_same] = mean_and_variance(same);
  const auto [mean_different, variance_different] = mean_and_variance(different);
  v.d_prime = (mean_different - mean_same) / std::sqrt(0.5 * (variance_same + variance_different));
  v.greatest_same_mm = same.back();
  v.least_different_mm = different.front();
  v.median_same_mm = same[same.size() / 2];
  v.median_different_mm = different[different.size() / 2];
  return v;
}

}  // namespace relievo::bench
