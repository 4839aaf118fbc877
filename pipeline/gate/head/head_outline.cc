// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/gate/head/head_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relievo::pipeline {
namespace {

constexpr double kFaceWidthMm = 150, kHeadMm = 200;  // from the crown to the chin
constexpr double kForeheadMm = 70;                   // from the crown: below it the face begins
constexpr double kBrowsMm = 75, kMouthMm = 25;       // from the tip of the nose
constexpr double kAsideMm = 170, kBehindMm = 150;    // of the tip: the head and its hair
constexpr double kBeforeMm = 40;                     // of the tip: brow, chin
constexpr double kNoseBeforeAxisMm = 105;
constexpr double kForemostShare = 0.05;  // specks are fewer

// Counts by millimetres, to say below which a share of them lies.
class Histogram {
 public:
  explicit Histogram(double from_mm) : from_mm_(from_mm) {}
  void add(double mm) {
    const auto bin = static_cast<std::ptrdiff_t>((mm - from_mm_) / kBinMm);
    ++count_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(bin, 0, kBins - 1))];
    ++all_;
  }
  double below(double share) const {
    int seen = 0;
    for (std::size_t i = 0; i < kBins; ++i)
      if ((seen += count_[i]) > share * all_) return from_mm_ + (static_cast<double>(i) + 0.5) * kBinMm;
    return from_mm_;
  }
  int all() const { return all_; }

 private:
  static constexpr double kBinMm = 8;
  static constexpr std::ptrdiff_t kBins = 256;
  double from_mm_;
  std::array<int, kBins> count_{};
  int all_ = 0;
};

struct Rows {
  int from, to;  // not with it
};

// Of what is so near, its foremost place in each row: the line of brow, nose, lips and chin.
HeadHint head_in(const Relief& relief, const Rows& rows, double reach_mm, bool crown_seen) {
  Histogram depth(0);
  for (int y = rows.from; y < rows.to; ++y)
    for (int x = 0; x < relief.width_px; ++x)
      if (relief.known(x, y) && static_cast<double>(relief.depth_mm[relief.index(x, y)]) < reach_mm)
        depth.add(static_cast<double>(relief.depth_mm[relief.index(x, y)]));
  if (depth.all() == 0) return {};
  const double near = depth.below(kForemostShare), per_mm = relief.focal_px / near;
  const Rows face{crown_seen ? rows.from + static_cast<int>(kForeheadMm * per_mm) : rows.from,
                  crown_seen ? std::min(rows.to, rows.from + static_cast<int>(kHeadMm * per_mm)) : rows.to};
  const auto of_head = [&](int x, int y) {
    return relief.known(x, y) && static_cast<double>(relief.depth_mm[relief.index(x, y)]) < near + kBehindMm;
  };
  Histogram aside(-1024);
  for (int y = face.from; y < face.to; ++y)
    for (int x = 0; x < relief.width_px; ++x)
      if (of_head(x, y)) aside.add(relief.point(x, y).x);
  if (aside.all() == 0) return {};
  const double middle = aside.below(0.5);
  double sum = 0;
  int seen = 0;
  for (int y = face.from; y < face.to; ++y) {
    double foremost = 1e9, at = 0;
    for (int x = 0; x < relief.width_px; ++x) {
      if (!of_head(x, y)) continue;
      const Vec3d p = relief.point(x, y);
      if (std::abs(p.x - middle) < kFaceWidthMm / 2 && p.z < foremost) foremost = p.z, at = x;
    }
    if (foremost < 1e9) sum += at, ++seen;
  }
  if (seen == 0) return {};
  return {{sum / seen, 0.5 * (face.from + face.to)}, kFaceWidthMm * per_mm};
}

}  // namespace

// The middle of all that is near says on which side somebody stands; its upper end whether they are too low,
// the neck whether they are too high. That it reaches the upper edge says nothing: most heads do.
Somebody find_somebody(const Relief& relief, double farthest_mm) {
  constexpr double kReach = 1.2, kLeastShare = 0.03, kClearly = 0.12, kNeckOfHead = 0.72, kHighNeck = 0.6,
                   kUsualNeck = 0.85;
  const int w = relief.width_px, h = relief.height_px;
  double count = 0, right = 0;
  int top = h, neck = h, widest = 0;
  for (int y = 0; y < h; ++y) {
    int in_row = 0;
    for (int x = 0; x < w; ++x) {
      if (!relief.known(x, y) ||
          static_cast<double>(relief.depth_mm[relief.index(x, y)]) > kReach * farthest_mm)
        continue;
      ++in_row;
      right += x;
    }
    count += in_row;
    if (top == h && in_row > w / 12) top = y;
    widest = std::max(widest, in_row);
    if (neck == h && widest > w / 6 && in_row < kNeckOfHead * widest) neck = y;
  }
  Somebody somebody;
  if (count < kLeastShare * w * h) return somebody;
  const double off = right / count / w - 0.5, low = static_cast<double>(top) / h - 0.5;
  if (std::abs(off) > kClearly) somebody.right = off;
  if (low > 0) somebody.down = low + kClearly;
  else if (neck < kHighNeck * h) somebody.down = static_cast<double>(neck) / h - kUsualNeck;
  somebody.head = head_in(relief, {top, neck}, kReach * farthest_mm, top > 2);
  return somebody;
}

double outline_yaw_deg(const Relief& relief, const Vec3d& tip_mm) {
  const Vec2d above = relief.pixel({tip_mm.x, tip_mm.y - kBrowsMm, tip_mm.z}),
              below = relief.pixel({tip_mm.x, tip_mm.y + kMouthMm, tip_mm.z});
  double sum = 0;
  int count = 0;
  for (int y = std::max(0, static_cast<int>(above.y));
       y <= std::min(relief.height_px - 1, static_cast<int>(below.y)); ++y)
    for (int x = 0; x < relief.width_px; ++x) {
      if (!relief.known(x, y)) continue;
      const Vec3d p = relief.point(x, y);
      if (p.z < tip_mm.z - kBeforeMm || p.z > tip_mm.z + kBehindMm || std::abs(p.x - tip_mm.x) > kAsideMm)
        continue;
      sum += p.x, ++count;
    }
  if (count == 0) return 0;
  const double sine = std::clamp((tip_mm.x - sum / count) / kNoseBeforeAxisMm, -0.9, 0.9);
  return std::asin(sine) * 180 / std::numbers::pi;
}

}  // namespace relievo::pipeline
