// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/face_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace relievo::pipeline {
namespace {

constexpr double kCellMm = 0.75;
constexpr double kSmoothMm = 1.0;
constexpr double kBelowMm = 105, kAboveMm = 90;     // of the tip: chin to hairline
constexpr double kTipReachMm = 16;                  // the frame's origin is that near to the tip
constexpr double kNasionFrom = 18, kNasionTo = 62;  // above the tip; Farkas: n to prn along y 35 .. 55
constexpr double kHullTop = 75;                     // the hull's other foot: brow and forehead
constexpr double kNasionDepth = 0.8;                // below the hull: less is no root of a nose
constexpr double kLipFoot = 38;                     // the upper lip ends above that, below the tip
constexpr double kSubnasaleDepth = 2.0;
constexpr double kChinFrom = -48, kChinTo = -98;  // sublabiale to the lowest chins, from the tip
constexpr double kChinRise = 0.3;                 // of the chin out of the fold above it
constexpr double kSecondRise = 0.5;  // as much lies a second fold behind what stands above and below it
constexpr double kLipBeforeChin = 8, kAboveChinMm = 3;

using Profile = std::span<const ProfilePoint>;

Profile part(Profile profile, double from_mm, double to_mm) {
  const auto before = [](const ProfilePoint& p, double y) { return p.y_mm < y; };
  const auto begin = std::lower_bound(profile.begin(), profile.end(), from_mm, before);
  const auto end = std::lower_bound(begin, profile.end(), to_mm, before);
  return {begin, end};
}

// The extreme of a parabola through a point and what lies within 3 mm of it; the point itself where that
// bends the other way.
ProfilePoint extreme_near(Profile profile, const ProfilePoint& at, double sign) {
  double s[5] = {0, 0, 0, 0, 0}, t[3] = {0, 0, 0};
  for (const ProfilePoint& p : part(profile, at.y_mm - 3.1, at.y_mm + 3.1)) {
    const double d = p.y_mm - at.y_mm;
    double power = 1;
    for (int k = 0; k < 5; ++k, power *= d) {
      s[k] += power;
      if (k < 3) t[k] += power * (p.z_mm - at.z_mm);
    }
  }
  const double m[3][4] = {{s[0], s[1], s[2], t[0]}, {s[1], s[2], s[3], t[1]}, {s[2], s[3], s[4], t[2]}};
  const auto det = [&](int a, int b, int c) {
    return m[0][a] * (m[1][b] * m[2][c] - m[1][c] * m[2][b]) -
           m[0][b] * (m[1][a] * m[2][c] - m[1][c] * m[2][a]) +
           m[0][c] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]);
  };
  const double whole = det(0, 1, 2);
  if (!(std::abs(whole) > 1e-6)) return at;
  const double c0 = det(3, 1, 2) / whole, c1 = det(0, 3, 2) / whole, c2 = det(0, 1, 3) / whole;
  if (!(c2 * sign < -1e-4)) return at;
  const double d = std::clamp(-c1 / (2 * c2), -2.5, 2.5);
  return {at.y_mm + d, at.z_mm + c0 + d * (c1 + d * c2)};
}

// Foremost (sign 1) or hindmost (-1); nothing where it is an end of the part, unless ends are allowed.
std::optional<ProfilePoint> extreme(Profile profile, double from_mm, double to_mm, double sign) {
  const Profile range = part(profile, from_mm, to_mm);
  if (range.size() < 6) return std::nullopt;
  const auto best = std::max_element(
      range.begin(), range.end(),
      [&](const ProfilePoint& a, const ProfilePoint& b) { return sign * a.z_mm < sign * b.z_mm; });
  if (best == range.begin() || best + 1 == range.end()) return std::nullopt;
  return extreme_near(profile, *best, sign);
}

// What lies deepest below the upper hull of [from, to], of what lies in [least, most].
struct Deepest {
  ProfilePoint at;
  double depth_mm = 0;
};
Deepest deepest_below_hull(Profile profile, double from_mm, double to_mm, double least_mm, double most_mm) {
  const Profile range = part(profile, from_mm, to_mm);
  Deepest deepest;
  std::size_t a = 0;
  while (a + 1 < range.size()) {
    // The next vertex of the hull is the one under the steepest chord.
    std::size_t b = a + 1;
    double steepest = -1e9;
    for (std::size_t i = a + 1; i < range.size(); ++i) {
      const double slope = (range[i].z_mm - range[a].z_mm) / (range[i].y_mm - range[a].y_mm);
      if (slope >= steepest) steepest = slope, b = i;
    }
    for (std::size_t i = a + 1; i < b; ++i) {
      if (range[i].y_mm < least_mm || range[i].y_mm > most_mm) continue;
      const double under = range[a].z_mm + steepest * (range[i].y_mm - range[a].y_mm) - range[i].z_mm;
      const double depth = under / std::sqrt(1 + steepest * steepest);
      if (depth > deepest.depth_mm) deepest = {range[i], depth};
    }
    a = b;
  }
  return deepest;
}

std::optional<ProfilePoint> find_nasion(Profile profile, const ProfilePoint& tip) {
  const Deepest root = deepest_below_hull(profile, tip.y_mm, tip.y_mm + kHullTop, tip.y_mm + kNasionFrom,
                                          tip.y_mm + kNasionTo);
  if (root.depth_mm < kNasionDepth) return std::nullopt;
  // Its depth along z, where that has an extreme: it hardly changes when the head nods.
  const auto lowest = extreme(profile, root.at.y_mm - 10, root.at.y_mm + 10, -1);
  return lowest ? *lowest : root.at;
}

// In an open mouth the first fold is the mouth, and what stands below it is the lower lip: then there is
// another fold further down, and the chin is what stands below that.
std::optional<ProfilePoint> below_lip(Profile profile, double from_mm, const ProfilePoint& lip) {
  const Profile below = part(profile, from_mm, lip.y_mm);
  double deepest = lip.z_mm;
  for (std::size_t k = below.size(); k-- > 0;) {
    deepest = std::min(deepest, below[k].z_mm);
    if (below[k].z_mm < deepest + kSecondRise || lip.z_mm < deepest + kSecondRise) continue;
    const auto chin = extreme(profile, from_mm, below[k].y_mm + kAboveChinMm, 1);
    if (chin && chin->z_mm > lip.z_mm - kLipBeforeChin) return chin;
    break;
  }
  return std::nullopt;
}

std::optional<ProfilePoint> find_chin(Profile profile, const ProfilePoint& tip) {
  const auto fold = extreme(profile, tip.y_mm + kChinTo + 20, tip.y_mm + kChinFrom + 10, -1);
  const double from = tip.y_mm + kChinTo;
  const double to = fold ? fold->y_mm : tip.y_mm + kChinFrom;
  const auto chin = extreme(profile, from, to, 1);
  if (!chin || (fold && chin->z_mm < fold->z_mm + kChinRise)) return std::nullopt;
  const auto lower = below_lip(profile, from, *chin);
  return lower ? lower : chin;
}

}  // namespace

std::pmr::vector<ProfilePoint> profile_of(const FaceMesh& mesh, const RigidTransform& frame_from_mesh,
                                          std::pmr::memory_resource* memory, bool completed_too) {
  constexpr double kHalfWidth = 6 * kCellMm;
  FaceRelief band({-kHalfWidth, kHalfWidth, -kBelowMm, kAboveMm, kCellMm}, memory);
  band.add(mesh, frame_from_mesh, completed_too);
  band.symmetrise();
  band.smooth(kSmoothMm, memory);
  std::pmr::vector<ProfilePoint> profile(memory);
  profile.reserve(static_cast<std::size_t>(band.rows()));
  for (int row = 0; row < band.rows(); ++row)
    if (const float z = band.z(band.columns() / 2, row); !std::isnan(z))
      profile.push_back({band.y_mm(row), static_cast<double>(z)});
  return profile;
}

ProfileMarks find_profile_marks(Profile profile) {
  ProfileMarks marks;
  marks.tip = extreme(profile, -kTipReachMm, kTipReachMm, 1);
  if (!marks.tip) return marks;
  marks.nasion = find_nasion(profile, *marks.tip);
  marks.chin = find_chin(profile, *marks.tip);
  const Deepest base = deepest_below_hull(profile, marks.tip->y_mm - kLipFoot, marks.tip->y_mm,
                                          marks.tip->y_mm - kLipFoot, marks.tip->y_mm - 3);
  if (base.depth_mm >= kSubnasaleDepth) marks.subnasale = base.at;
  return marks;
}

}  // namespace relievo::pipeline
