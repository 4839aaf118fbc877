// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/preprocess/preprocessors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace relievo::pipeline {
namespace {

constexpr int kBands = 8;

// Left pixel x and right pixel x - shift count together.
struct Overlap {
  const RectifiedPair& pair;
  int shift_px;

  explicit Overlap(const RectifiedPair& of) : pair(of), shift_px(0) {
    // Harmonic middle of the volume: half of its disparities on either side.
    const double middle = 0.5 * (of.disparity_px(of.near_mm) + of.disparity_px(of.far_mm));
    if (of.near_mm > 0 && of.far_mm > 0 && std::abs(middle) < of.width_px)
      shift_px = int(std::lround(middle));
  }
  bool holds(int left_x, int y) const {
    const int right_x = left_x - shift_px;
    if (left_x < 0 || right_x < 0 || left_x >= pair.width_px || right_x >= pair.width_px) return false;
    const std::size_t left = pair.index(left_x, y);
    return pair.left.valid[left] != 0 && pair.right.valid[pair.index(right_x, y)] != 0 &&
           (pair.region.empty() || pair.region[left] != 0);
  }
};

// By a monotone map, tabulated finely enough for the curves above; linear in between.
template <typename Map>
void map_greys(std::pmr::vector<float>& greys, ThreadPool& pool, const Map& map) {
  constexpr int kPerLevel = 16;
  std::array<float, 255 * kPerLevel + 1> table{};
  for (std::size_t k = 0; k < table.size(); ++k) table[k] = float(map(double(k) / kPerLevel));
  pool.for_each<std::size_t>(int(greys.size()), kBands, [&](std::size_t i) {
    const float at = std::clamp(greys[i], 0.0F, 255.0F) * kPerLevel;
    const auto k = std::min(std::size_t(at), table.size() - 2);
    greys[i] = table[k] + (at - float(k)) * (table[k + 1] - table[k]);
  });
}

}  // namespace

GreyHistogram GreyHistogram::of(const std::pmr::vector<float>& grey, int width_px, int height_px,
                                const Wanted& wanted, ThreadPool& pool) {
  std::array<std::array<std::uint64_t, kLevels>, kBands> counts{};
  pool.for_each(height_px, kBands, [&](int y, int band) {
    auto& count = counts[std::size_t(band)];
    const float* row = grey.data() + std::ptrdiff_t(y) * width_px;
    for (int x = 0; x < width_px; ++x)
      if (wanted(x, y)) ++count[std::size_t(std::clamp(std::lround(row[x]), 0L, kLevels - 1L))];
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

Result<void> HistogramNormaliser::process(RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  for (RectifiedView* view : {&pair.left, &pair.right}) {
    if (context.stop()) return stopped();
    const auto valid = [&](int x, int y) { return view->valid[pair.index(x, y)] != 0; };
    const GreyHistogram histogram =
        GreyHistogram::of(view->grey, pair.width_px, pair.height_px, valid, context.pool);
    if (histogram.count() == 0) continue;
    const double dark = histogram.grey_at(tail);
    // Noise of one level is no picture.
    const double range = std::max(1.0, histogram.grey_at(1 - tail) - dark);
    map_greys(view->grey, context.pool, [&](double grey) {
      const double stretched = std::clamp((grey - dark) / range, 0.0, 1.0);
      return 255 * (stretched + equalise * (histogram.share_below(grey) - stretched));
    });
  }
  return {};
}

Result<void> HistogramTransfer::process(RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  if (context.stop()) return stopped();
  const Overlap overlap(pair);
  const auto in_left = [&](int x, int y) { return overlap.holds(x, y); };
  const auto in_right = [&](int x, int y) { return overlap.holds(x + overlap.shift_px, y); };
  const GreyHistogram left =
      GreyHistogram::of(pair.left.grey, pair.width_px, pair.height_px, in_left, context.pool);
  const GreyHistogram right =
      GreyHistogram::of(pair.right.grey, pair.width_px, pair.height_px, in_right, context.pool);
  if (left.count() == 0) return {};
  if (context.stop()) return stopped();
  map_greys(pair.right.grey, context.pool,
            [&](double grey) { return grey + strength * (left.grey_at(right.share_below(grey)) - grey); });
  return {};
}

}  // namespace relievo::pipeline
