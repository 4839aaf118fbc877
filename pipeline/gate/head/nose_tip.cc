// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "hal/base/statistics.h"
#include "pipeline/gate/head/head_measurement.h"
#include "pipeline/match/region/face_reach.h"
#include "pipeline/model/vector3.h"

namespace relievo::pipeline {
namespace {

constexpr double kStickOutMm = 60;  // nothing of a face is nearer than its middle by more
constexpr std::size_t kLeastPoints = 60;
// The face about the hint's middle, and where on it a nose can be, in widths of the hint (150 mm): heads
// bowed by 20 degrees either way have it at 0.03 and at 0.23; a tongue is at 0.3 or lower, a brow at -0.15 or
// higher.
constexpr double kFaceAside = 0.30, kFaceUp = 0.32, kFaceDown = 0.40;
constexpr double kTipAside = 0.24, kTipUp = -0.05, kTipDown = 0.27;

constexpr double kNoseAsideMm = 14;  // of the mirror plane
constexpr double kBinMm = 2;
constexpr int kBins = 61;                  // of the profile: 60 mm above and below the tip as it was
constexpr double kRidgeHalfMm = 7;         // of the nose, beside the mirror plane
constexpr double kPeakMm = 5;              // about the peak the nose is as round as that
constexpr double kTipMm = 8;               // about the peak,
constexpr std::ptrdiff_t kTipPoints = 10;  // the foremost so many make the tip
constexpr double kNoseMm = 8;              // a peak stands out before the corner below it by that
constexpr double kCornerMm = 18;           // which lies so far below it at most

struct PixelBox {
  int x0, x1, y0, y1;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  std::size_t room() const { return std::size_t((x1 - x0 + 1) * (y1 - y0 + 1)); }
};

PixelBox box_about(const Relief& relief, const Vec2d& at, double left, double right, double up, double down) {
  return {std::max(0, int(at.x - left)), std::min(relief.width_px - 1, int(at.x + right)),
          std::max(0, int(at.y - up)), std::min(relief.height_px - 1, int(at.y + down))};
}

// The nose along the mirror plane: how far it stands out (towards where the head faces) every kBinMm
// downwards.
struct Profile {
  std::array<double, kBins> out{};
  std::array<bool, kBins> known{};
  static double down(int bin) { return (bin - kBins / 2) * kBinMm; }
};

// Points about the old tip, in the head's own axes made upright by its pitch.
struct NosePoint {
  double right, down, out;
};

struct HeldAxes {
  Vec3d right, down, out;
  explicit HeldAxes(const HeadMeasurement& head) : right(head.right) {
    const double pitch = head.pitch_deg * std::numbers::pi / 180;
    down = along(times(head.down, std::cos(pitch)), std::sin(pitch), head.away);
    out = along(times(head.away, -std::cos(pitch)), std::sin(pitch), head.down);
  }
  NosePoint of(const Vec3d& d) const { return {dot(d, right), dot(d, down), dot(d, out)}; }
};

Profile profile_of(std::span<const NosePoint> points, double midline_mm) {
  std::array<double, kBins> total{}, count{};
  for (const NosePoint& p : points) {
    if (std::abs(p.right - midline_mm) > kRidgeHalfMm) continue;
    const int bin = int(std::lround(p.down / kBinMm)) + kBins / 2;
    if (bin < 0 || bin >= kBins) continue;
    total[std::size_t(bin)] += p.out;
    count[std::size_t(bin)] += 1;
  }
  Profile profile;
  for (std::size_t i = 0; i < kBins; ++i) {  // smoothed over three bins
    double s = 0, n = 0;
    for (std::size_t k = i == 0 ? 0 : i - 1; k <= std::min<std::size_t>(i + 1, kBins - 1); ++k) {
      const double weight = k == i ? 2 : 1;
      s += weight * total[k], n += weight * count[k];
    }
    profile.known[i] = n >= 4;
    profile.out[i] = n > 0 ? s / n : 0;
  }
  return profile;
}

// How far the profile falls back below a peak.
double corner_below(const Profile& profile, int bin) {
  double most = 0;
  for (int k = bin + 1; k < kBins && k <= bin + int(kCornerMm / kBinMm); ++k)
    if (profile.known[std::size_t(k)])
      most = std::max(most, profile.out[std::size_t(bin)] - profile.out[std::size_t(k)]);
  return most;
}

// The foremost bin within the window; of several peaks, each with a corner below it, the uppermost: what is
// put out below the nose is a tongue.
int peak_of(const Profile& profile, double from_mm, double to_mm) {
  int best = -1, upper = -1;
  const auto at = [&](int k) { return profile.out[std::size_t(k)]; };
  for (int k = 0; k < kBins; ++k)
    if (profile.known[std::size_t(k)] && Profile::down(k) >= from_mm && Profile::down(k) <= to_mm &&
        (best < 0 || at(k) > at(best)))
      best = k;
  if (best < 0) return best;
  for (int k = 0; k < best; ++k)
    if (profile.known[std::size_t(k)] && Profile::down(k) >= from_mm && (upper < 0 || at(k) > at(upper)) &&
        corner_below(profile, k) > kNoseMm)
      upper = k;
  return upper >= 0 ? upper : best;
}

// Where across the ridge stands out most, about a height of the profile.
double midline_at(std::span<const NosePoint> points, double midline_mm, double down_mm) {
  ThreeTerms terms;
  for (const NosePoint& p : points) {
    const double right = p.right - midline_mm;
    if (std::abs(right) < kNoseAsideMm && std::abs(p.down - down_mm) < kPeakMm)
      terms.add({1, right, right * right}, p.out);
  }
  const auto k = terms.solve();
  if (!k || (*k)[2] > -0.01) return midline_mm;
  return midline_mm + std::clamp(-(*k)[1] / (2 * (*k)[2]), -kRidgeHalfMm, kRidgeHalfMm);
}

// About the peak: the mean of the foremost points, since that of all would lie under the skin. Nothing where
// there are none.
std::optional<NosePoint> foremost(std::span<NosePoint> points, double midline_mm, double down_mm) {
  const auto about = [&](const NosePoint& p) {
    return std::hypot(p.right - midline_mm, p.down - down_mm) < kTipMm;
  };
  const auto end = std::partition(points.begin(), points.end(), about);
  const auto count = std::min<std::ptrdiff_t>(kTipPoints, end - points.begin());
  if (count == 0) return std::nullopt;
  std::nth_element(points.begin(), points.begin() + count - 1, end,
                   [](const NosePoint& a, const NosePoint& b) { return a.out > b.out; });
  NosePoint mean{midline_mm, 0, 0};
  for (const NosePoint& p : points.first(std::size_t(count))) {
    mean.down += p.down / double(count), mean.out += p.out / double(count);
  }
  return mean;
}

std::pmr::vector<NosePoint> points_about(const Relief& relief, const Vec3d& tip, const HeldAxes& axes,
                                         StageContext& context) {
  std::pmr::vector<NosePoint> points(&context.scratch);
  const double reach = (kBins / 2 + 1) * kBinMm, px = reach * relief.focal_px / tip.z;
  const PixelBox box = box_about(relief, relief.pixel(tip), px, px, px, px);
  if (box.empty()) return points;
  points.reserve(box.room());
  for (int y = box.y0; y <= box.y1; ++y)
    for (int x = box.x0; x <= box.x1; ++x) {
      if (!relief.known(x, y)) continue;
      const NosePoint p = axes.of(minus(relief.point(x, y), tip));
      if (std::abs(p.right) < 2 * kNoseAsideMm && std::abs(p.down) < reach && std::abs(p.out) < kStickOutMm)
        points.push_back(p);
    }
  return points;
}

}  // namespace

bool rough_tip(const Relief& relief, const HeadHint& hint, StageContext& context, Vec3d& tip) {
  std::pmr::vector<Vec3d> points(&context.scratch);
  std::pmr::vector<float> depth(&context.scratch);
  const double w = hint.width_px;
  const PixelBox box =
      box_about(relief, hint.centre_px, kFaceAside * w, kFaceAside * w, kFaceUp * w, kFaceDown * w);
  if (box.empty()) return false;
  points.reserve(box.room());
  depth.reserve(box.room());
  for (int y = box.y0; y <= box.y1; ++y)
    for (int x = box.x0; x <= box.x1; ++x) {
      if (!relief.known(x, y)) continue;
      points.push_back(relief.point(x, y));
      depth.push_back(relief.depth_mm[relief.index(x, y)]);
    }
  if (depth.size() < kLeastPoints || depth.size() < box.room() / 4) return false;
  const double z = median(depth);
  // Most of what is there: a box as wide as a face of this distance, or it is none.
  const double width_mm = w * z / relief.focal_px;
  if (width_mm < 85 || width_mm > 260) return false;
  std::erase_if(points, [&](const Vec3d& p) { return std::abs(p.z - z) >= kStickOutMm; });
  const auto may_be_tip = [&](const Vec3d& p) {
    const Vec2d at = relief.pixel(p);
    const double u = (at.x - hint.centre_px.x) / w, v = (at.y - hint.centre_px.y) / w;
    return std::abs(u) < kTipAside && v > kTipUp && v < kTipDown;
  };
  const auto candidates =
      std::size_t(std::partition(points.begin(), points.end(), may_be_tip) - points.begin());
  if (candidates < kLeastPoints) return false;
  tip = outstanding_tip(points, candidates);
  return true;
}

bool tip_of_profile(const Relief& relief, const HeadHint& hint, const HeadMeasurement& head,
                    StageContext& context, Vec3d& tip) {
  Arena::Mark mark(context.scratch);
  const HeldAxes axes(head);
  std::pmr::vector<NosePoint> points = points_about(relief, head.tip_mm, axes, context);
  // The hint's middle, at the depth of the tip: from there the window is counted.
  const Vec3d middle = relief.point(hint.centre_px.x, hint.centre_px.y, head.tip_mm.z);
  const double hint_mm = hint.width_px * head.tip_mm.z / relief.focal_px,
               centre = axes.of(minus(middle, head.tip_mm)).down;
  double midline = 0;
  int peak = -1;
  for (int round = 0; round < 2; ++round) {
    const Profile profile = profile_of(points, midline);
    peak = peak_of(profile, centre + kTipUp * hint_mm, centre + kTipDown * hint_mm);
    if (peak < 0) return false;
    midline = std::clamp(midline_at(points, midline, Profile::down(peak)), -kNoseAsideMm, kNoseAsideMm);
  }
  const std::optional<NosePoint> at = foremost(points, midline, Profile::down(peak));
  if (!at) return false;
  tip = along(along(along(head.tip_mm, at->right, axes.right), at->down, axes.down), at->out, axes.out);
  return true;
}

}  // namespace relievo::pipeline
