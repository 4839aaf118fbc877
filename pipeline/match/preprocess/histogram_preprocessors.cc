// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/preprocess/preprocessors.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/preprocess/grey_histogram.h"

namespace relievo::pipeline {
namespace {

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

}  // namespace

Result<void> HistogramNormaliser::process(RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  for (RectifiedView* view : {&pair.left, &pair.right}) {
    if (context.stop()) return Error{Errc::Cancelled, "the preprocessing was stopped"};
    const auto valid = [&](int x, int y) { return view->valid[pair.index(x, y)] != 0; };
    const GreyHistogram histogram =
        GreyHistogram::of(view->grey, pair.width_px, pair.height_px, valid, context.pool);
    if (histogram.count() == 0) continue;
    const double dark = histogram.grey_at(tail);
    // Noise of one level is no picture.
    const double range = std::max(1.0, histogram.grey_at(1 - tail) - dark);
    GreyMap([&](double grey) {
      const double stretched = std::clamp((grey - dark) / range, 0.0, 1.0);
      return 255 * (stretched + equalise * (histogram.share_below(grey) - stretched));
    }).apply(view->grey, context.pool);
  }
  return {};
}

Result<void> HistogramTransfer::process(RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  if (context.stop()) return Error{Errc::Cancelled, "the preprocessing was stopped"};
  const Overlap overlap(pair);
  const auto in_left = [&](int x, int y) { return overlap.holds(x, y); };
  const auto in_right = [&](int x, int y) { return overlap.holds(x + overlap.shift_px, y); };
  const GreyHistogram left =
      GreyHistogram::of(pair.left.grey, pair.width_px, pair.height_px, in_left, context.pool);
  const GreyHistogram right =
      GreyHistogram::of(pair.right.grey, pair.width_px, pair.height_px, in_right, context.pool);
  if (left.count() == 0) return {};
  if (context.stop()) return Error{Errc::Cancelled, "the preprocessing was stopped"};
  GreyMap([&](double grey) {
    return grey + strength * (left.grey_at(right.share_below(grey)) - grey);
  }).apply(pair.right.grey, context.pool);
  return {};
}

}  // namespace relievo::pipeline
