// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/window/row_search.h"

#include <algorithm>
#include <cmath>

#include "pipeline/match/window/window_correlation.h"
#include "pipeline/match/window/window_matching.h"

namespace relievo::pipeline {

std::optional<Match> match_on_row(const RectifiedPair& pair, Vec2f left_px, double least_px, double most_px,
                                  int radius) {
  const double wide = pair.width_px;
  const int first = static_cast<int>(std::ceil(std::clamp(least_px, -wide, wide))),
            last = static_cast<int>(std::floor(std::clamp(most_px, -wide, wide)));
  const auto alike = [&](int disparity) {
    return window_correlation(pair, left_px, {left_px.x - static_cast<float>(disparity), left_px.y}, radius);
  };
  double best = 0;
  int at = first;
  for (int d = first; d <= last; ++d)
    if (const double here = alike(d); here > best) best = here, at = d;
  if (at == first || at >= last) return std::nullopt;
  const double before = alike(at - 1), after = alike(at + 1), bend = 2 * best - before - after;
  if (!(bend > 0)) return std::nullopt;
  const double samples = (2 * radius + 1) * (2 * radius + 1);
  const double unlike = std::max(1 - best, 1e-6 * bend);
  return Match{left_px, static_cast<float>(at + (after - before) / (2 * bend)), static_cast<float>(1 - best),
               static_cast<float>(std::hypot(std::sqrt(2 * unlike / (samples * bend)),
                                             method_bias_px(pair, 2 * radius + 1))),
               0};
}

}  // namespace relievo::pipeline
