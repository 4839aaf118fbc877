// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/preprocess/histogram_normaliser.h"

#include <algorithm>

#include "pipeline/match/preprocess/grey_histogram.h"

namespace relievo::pipeline {

Result<void> HistogramNormaliser::process(RectifiedPair& pair, StageContext& context) const {
  RELIEVO_TRY(check_pixels(pair));
  for (RectifiedView* view : {&pair.left, &pair.right}) {
    if (context.stop()) return Error{Errc::Cancelled, "the preprocessing was stopped"};
    const auto valid = [&](int x, int y) {
      return view->valid[static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.width_px) +
                         static_cast<std::size_t>(x)] != 0;
    };
    const GreyHistogram histogram =
        GreyHistogram::of(view->grey, pair.width_px, pair.height_px, valid, context.pool);
    if (histogram.count() == 0) continue;
    const double dark = histogram.grey_at(tail);
    const double range =
        std::max(1.0, histogram.grey_at(1 - tail) - dark);  // noise of one level is no picture
    GreyMap([&](double grey) {
      const double stretched = std::clamp((grey - dark) / range, 0.0, 1.0);
      return 255 * (stretched + equalise * (histogram.share_below(grey) - stretched));
    }).apply(view->grey, context.pool);
  }
  return {};
}

}  // namespace relievo::pipeline
