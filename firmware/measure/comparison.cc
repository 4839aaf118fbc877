// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/measure/comparison.h"

#include <algorithm>

#include "hal/base/statistics.h"

namespace relievo::firmware::compare {
namespace {

double share(std::size_t part, std::size_t whole) { return whole == 0 ? 0 : double(part) / double(whole); }

void count_error(ErrorHistogram& histogram, double error) {
  constexpr double kWidth = 2 * ErrorHistogram::kReachPx / ErrorHistogram::kBins;
  const double bin = std::floor((error + ErrorHistogram::kReachPx) / kWidth);
  ++histogram.counts[std::size_t(std::clamp(bin, 0.0, ErrorHistogram::kBins - 1.0))];
}

// The figures of the errors themselves.
void describe_errors(std::vector<double>& errors, double within_sum, std::size_t within, DisparityScore& s) {
  double sum = 0;
  double squares = 0;
  for (const double e : errors) {
    sum += e;
    squares += e * e;
  }
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  s.mean_px = errors.empty() ? nothing : sum / double(errors.size());
  s.rms_px = errors.empty() ? nothing : std::sqrt(squares / double(errors.size()));
  s.median_px = median(errors);
  s.p95_px = percentile(errors, 0.95);
  s.bias_px = within == 0 ? nothing : within_sum / double(within);
}

}  // namespace

DisparityScore score(const DisparityMap& map, const DisparityTruth& truth, double limit_px) {
  DisparityScore s;
  constexpr std::array kLimits{0.5, 1.0, 2.0, 4.0};
  std::array<std::size_t, 5> good{};
  std::size_t good_seen = 0;
  double within_sum = 0;
  std::vector<double> errors;
  for (std::size_t k = 0; k < truth.map.values.size(); ++k) {
    if (std::isnan(truth.map.values[k])) continue;
    ++s.judged;
    s.seen += truth.seen[k];
    if (std::isnan(map.values[k])) continue;
    const double error = double(map.values[k]) - double(truth.map.values[k]);
    errors.push_back(std::abs(error));
    count_error(s.histogram, error);
    for (std::size_t i = 0; i < kLimits.size(); ++i) good[i] += errors.back() <= kLimits[i] ? 1 : 0;
    if (errors.back() > limit_px) continue;
    ++good[4];
    good_seen += truth.seen[k];
    within_sum += error;
  }
  s.given = errors.size();
  s.density = share(s.given, s.judged);
  s.bad_half = share(s.judged - good[0], s.judged);
  s.bad_1 = share(s.judged - good[1], s.judged);
  s.bad_2 = share(s.judged - good[2], s.judged);
  s.bad_4 = share(s.judged - good[3], s.judged);
  s.bad_limit = share(s.judged - good[4], s.judged);
  s.bad_given = share(s.given - good[4], s.given);
  s.bad_seen = share(s.seen - good_seen, s.seen);
  describe_errors(errors, within_sum, good[4], s);
  return s;
}

SharedScore score_shared(const DisparityMap& one, const DisparityMap& other, const DisparityTruth& truth,
                         double limit_px) {
  SharedScore s;
  std::vector<double> errors;
  std::vector<double> other_errors;
  for (std::size_t k = 0; k < truth.map.values.size(); ++k) {
    if (std::isnan(truth.map.values[k]) || std::isnan(one.values[k]) || std::isnan(other.values[k])) continue;
    const auto truly = double(truth.map.values[k]);
    errors.push_back(std::abs(double(one.values[k]) - truly));
    other_errors.push_back(std::abs(double(other.values[k]) - truly));
  }
  const auto bad = [limit_px](const std::vector<double>& all) {
    return share(std::size_t(std::ranges::count_if(all, [limit_px](double e) { return e > limit_px; })),
                 all.size());
  };
  s.shared = errors.size();
  s.bad_one = bad(errors);
  s.bad_other = bad(other_errors);
  s.median_one_px = median(errors);
  s.median_other_px = median(other_errors);
  return s;
}

}  // namespace relievo::firmware::compare
