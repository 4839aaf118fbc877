// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/diagnose/overexposure.h"

#include <cstddef>

namespace relievo::pipeline {
namespace {

constexpr double kFaceWidthMm = 150;                   // a grown-up's, as in RectifiedPair::face_width_px
constexpr double kHalfWidth = 0.4, kHalfHeight = 0.5;  // of that width: an ellipse of skin, no background
constexpr int kEveryTexel = 2;                         // pixels looked at

struct Oval {
  double x, y, half_width, half_height;
  bool holds(double px, double py) const {
    const double u = (px - x) / half_width, v = (py - y) / half_height;
    return u * u + v * v < 1;
  }
};

Oval oval(double x, double y, double face_width) {
  return {x, y, kHalfWidth * face_width, kHalfHeight * face_width};
}

double white_share(const RectifiedView& view, const RectifiedPair& pair, const Oval& face) {
  long seen = 0, white = 0;
  for (int y = 0; y < pair.height_px; y += kEveryTexel)
    for (int x = 0; x < pair.width_px; x += kEveryTexel) {
      const std::size_t k =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(pair.width_px) + static_cast<std::size_t>(x);
      if (!view.valid[k] || !face.holds(x, y)) continue;
      ++seen;
      if (view.grey[k] >= kWhiteGrey) ++white;
    }
  return seen > 0 ? static_cast<double>(white) / static_cast<double>(seen) : 0;
}

}  // namespace

Overexposure measure_overexposure(const RectifiedPair& pair, const MatchSet& matches) {
  if (pair.face_width_px <= 0) return {};
  const Oval left = oval(pair.face_centre_px.x, pair.face_centre_px.y, pair.face_width_px);
  double sum = 0;
  long count = 0;
  for (const Match& m : matches.matches) {
    if (m.rejected_by != 0 || !left.holds(static_cast<double>(m.left_px.x), static_cast<double>(m.left_px.y)))
      continue;
    sum += static_cast<double>(m.disparity_px);
    ++count;
  }
  Oval right = left;
  right.x -= count > 0 ? sum / static_cast<double>(count) : 0;
  return {white_share(pair.left, pair, left), white_share(pair.right, pair, right)};
}

Overexposure guess_overexposure(const RectifiedPair& pair) {
  const double width = pair.focal_px * kFaceWidthMm / ((pair.near_mm + pair.far_mm) / 2);
  const Oval middle = oval(pair.width_px / 2.0, pair.height_px / 2.0, width);
  return {white_share(pair.left, pair, middle), white_share(pair.right, pair, middle)};
}

}  // namespace relievo::pipeline
