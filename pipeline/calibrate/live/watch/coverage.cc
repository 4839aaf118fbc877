// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/watch/coverage.h"

#include <algorithm>

namespace relievo::pipeline {
namespace {

constexpr double kRangeX = 0.7;
constexpr double kRangeY = 0.7;
constexpr double kRangeSize = 0.4;
constexpr double kRangeSkew = 0.5;

double bar(double range, double full) { return std::clamp(range / full, 0.0, 1.0); }

}  // namespace

double CoverageBars::least() const { return std::min({x, y, size, skew}); }

CoverageBars lesser(const CoverageBars& a, const CoverageBars& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.size, b.size), std::min(a.skew, b.skew)};
}

double CoverageMap::share() const {
  const auto covered = std::count_if(count.begin(), count.end(), [](std::uint32_t n) { return n > 0; });
  return static_cast<double>(covered) / static_cast<double>(count.size());
}

void Coverage::Range::widen(const BoardParameters& by) {
  low_x = std::min(low_x, by.x);
  high_x = std::max(high_x, by.x);
  low_y = std::min(low_y, by.y);
  high_y = std::max(high_y, by.y);
  size = std::max(size, by.size);
  skew = std::max(skew, by.skew);
}

CoverageBars Coverage::bars_of(const Range& r) {
  return {bar(r.high_x - r.low_x, kRangeX), bar(r.high_y - r.low_y, kRangeY), bar(r.size, kRangeSize),
          bar(r.skew, kRangeSkew)};
}

CoverageBars Coverage::bars_with(const BoardParameters& one_more) const {
  Range range = range_;
  range.widen(one_more);
  return bars_of(range);
}

void Coverage::add(const BoardCorners& corners, const BoardParameters& parameters, int width_px,
                   int height_px) {
  range_.widen(parameters);
  for (const Vec2d& at : corners) {
    if (!seen(at)) continue;
    const int column =
        std::clamp(static_cast<int>((at.x + 0.5) / width_px * kCoverageColumns), 0, kCoverageColumns - 1);
    const int row =
        std::clamp(static_cast<int>((at.y + 0.5) / height_px * kCoverageRows), 0, kCoverageRows - 1);
    ++map_.count[static_cast<std::size_t>(row * kCoverageColumns + column)];
  }
}

}  // namespace relievo::pipeline
