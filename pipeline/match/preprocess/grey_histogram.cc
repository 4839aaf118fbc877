// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/preprocess/grey_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace relievo::pipeline {
namespace {

constexpr int kBands = 8;

}  // namespace

GreyHistogram GreyHistogram::of(const std::pmr::vector<float>& grey, int width_px, int height_px,
                                const Wanted& wanted, ThreadPool& pool) {
  std::array<std::array<std::uint64_t, kLevels>, kBands> counts{};
  pool.for_each_band(height_px, kBands, [&](int begin, int end, int band) {
    auto& count = counts[std::size_t(band)];
    for (int y = begin; y < end; ++y) {
      const float* row = grey.data() + std::ptrdiff_t(y) * width_px;
      for (int x = 0; x < width_px; ++x)
        if (wanted(x, y)) ++count[std::size_t(std::clamp(std::lround(row[x]), 0L, kLevels - 1L))];
    }
  });
  GreyHistogram histogram;
  for (std::size_t k = 0; k < kLevels; ++k) {
    histogram.below_[k + 1] = histogram.below_[k];
    for (const auto& count : counts) histogram.below_[k + 1] += count[k];
  }
  return histogram;
}

double GreyHistogram::share_below(double grey) const {
  const double at = std::clamp(grey + 0.5, 0.0, double(kLevels));
  const auto k = std::min(std::size_t(at), std::size_t(kLevels - 1));
  const double from = double(below_[k]);
  const double to = double(below_[k + 1]);
  return (from + (at - double(k)) * (to - from)) / double(count());
}

double GreyHistogram::grey_at(double share) const {
  const double wanted = std::clamp(share, 0.0, 1.0) * double(count());
  // The first and the last place where the curve has this height; they differ in a gap.
  const auto crossing = [&](std::size_t k) {
    const double from = double(below_[k]);
    const double to = double(below_[k + 1]);
    return double(k) - 0.5 + (to > from ? std::clamp((wanted - from) / (to - from), 0.0, 1.0) : 0.0);
  };
  std::size_t first = 0;
  while (first + 1 < kLevels && double(below_[first + 1]) < wanted) ++first;
  std::size_t last = kLevels - 1;
  while (last > 0 && double(below_[last]) > wanted) --last;
  if (wanted <= 0) return crossing(last);                 // the darkest pixel
  if (wanted >= double(count())) return crossing(first);  // the brightest
  return 0.5 * (crossing(first) + crossing(last));
}

GreyMap::GreyMap(const std::function<double(double)>& map) {
  for (std::size_t k = 0; k < table_.size(); ++k) table_[k] = float(map(double(k) / kPerLevel));
}

float GreyMap::operator()(float grey) const {
  const float at = std::clamp(grey, 0.0F, 255.0F) * kPerLevel;
  const auto k = std::min(std::size_t(at), table_.size() - 2);
  return table_[k] + (at - float(k)) * (table_[k + 1] - table_[k]);
}

void GreyMap::apply(std::pmr::vector<float>& grey, ThreadPool& pool) const {
  pool.for_each_band(int(grey.size()), kBands, [&](int begin, int end, int) {
    for (int k = begin; k < end; ++k) grey[std::size_t(k)] = (*this)(grey[std::size_t(k)]);
  });
}

}  // namespace relievo::pipeline
