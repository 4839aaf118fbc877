// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/face_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Cholesky>

#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

using Eigen::Vector3d;

constexpr double kCoreHalf = 50, kCoreFrom = -30, kCoreTo = 78;
constexpr double kCoreCell = 1.25;
constexpr double kTipReach = 11;     // mm around the tip: both wings' flanks belong to it
constexpr double kRidgeShare = 0.2;  // of the vote of the nose's sides: highlights lie on the ridge
constexpr double kTipScale = 1.0;    // mm: what lies further off the paraboloid counts little

// A window beside or above the nose: its height and lean at its middle, by a quadratic through what was
// seen of it, so that a part that is missing shifts nothing.
struct Window {
  double from_x, to_x, from_y, to_y;
};
// Of a head held upright (nasion above pogonion, as in the Frankfurt plane): 10 +- 3 degrees.
constexpr double kBrowBeforeCheeks = 10 * std::numbers::pi / 180;
constexpr Window kCheek{18, 46, -22, 16}, kBrow{0, 30, 50, 76};

bool height_at_middle(const FaceRelief& core, const Window& w, double& z_mm) {
  using Vector5d = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> a = Eigen::Matrix<double, 5, 5>::Identity() * 1e-6;
  Vector5d b = Vector5d::Zero();
  const double middle_x = 0.5 * (w.from_x + w.to_x), middle_y = 0.5 * (w.from_y + w.to_y);
  int count = 0;
  for (int r = 0; r < core.rows(); ++r)
    for (int c = 0; c < core.columns(); ++c) {
      const double x = core.x_mm(c), y = core.y_mm(r), z = double(core.z(c, r));
      if (std::isnan(z) || x < w.from_x || x > w.to_x || y < w.from_y || y > w.to_y || z < -70) continue;
      Vector5d row;
      const double u = (x - middle_x) / 20, v = (y - middle_y) / 20;
      row << 1, u, v, u * u, v * v;
      a += row * row.transpose();
      b += row * z;
      ++count;
    }
  z_mm = solved<5>(a, b)[0];
  return count > 200;
}

double nod_of(const FaceRelief& core) {
  double cheek = 0, brow = 0;
  if (!height_at_middle(core, kCheek, cheek) || !height_at_middle(core, kBrow, brow)) return 0;
  return std::atan2(brow - cheek, 0.5 * (kBrow.from_y + kBrow.to_y - kCheek.from_y - kCheek.to_y)) -
         kBrowBeforeCheeks;
}

// Foremost point of a paraboloid, upright in x, through the surface around the foremost place near the
// origin. Robust (Geman-McClure): a highlight or the nose's limb may have pulled a part of it away.
Vector3d tip_of(const FaceRelief& core) {
  Vector3d top(0, 0, -1e9);
  for (int r = 0; r < core.rows(); ++r)
    for (int c = 0; c < core.columns(); ++c)
      if (std::abs(core.x_mm(c)) < 4 && std::abs(core.y_mm(r)) < 16 && double(core.z(c, r)) > top.z())
        top = {0, core.y_mm(r), double(core.z(c, r))};
  if (top.z() < -1e8) return Vector3d::Zero();
  Eigen::Vector4d k = Eigen::Vector4d::Zero();
  for (int turn = 0; turn < 12; ++turn) {
    Eigen::Matrix4d a = Eigen::Matrix4d::Identity() * 1e-6;
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (int r = 0; r < core.rows(); ++r)
      for (int c = 0; c < core.columns(); ++c) {
        const double x = core.x_mm(c), y = core.y_mm(r) - top.y(), z = double(core.z(c, r)) - top.z();
        const double q = (x * x + y * y) / (kTipReach * kTipReach);
        if (!(q < 1) || !(std::abs(z) < 12)) continue;
        const Eigen::Vector4d row(1, y, y * y, x * x);
        const double e = turn < 2 ? 0 : (z - row.dot(k)) / kTipScale;
        const double beside = kRidgeShare + (1 - kRidgeShare) * std::min(1.0, x * x / 25);
        const double w = beside * (1 - q) * (1 - q) / ((1 + e * e) * (1 + e * e));
        a += w * row * row.transpose();
        b += w * row * z;
      }
    k = a.ldlt().solve(b);
    if (!(k[2] < -1e-4)) break;
    const double y = std::clamp(-k[1] / (2 * k[2]), -3.0, 3.0);
    top += Vector3d(0, y, k[0] + y * (k[1] + y * k[2]));
    k = {0, 0, k[2], k[3]};
    if (turn > 3 && std::abs(y) < 1e-3) break;
  }
  return top;
}

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
constexpr double kRecedingFrom = -54;  // lower than lips

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

// Foremost (sign 1) or hindmost (-1); nothing where it is an end of the part.
std::optional<ProfilePoint> extreme(Profile profile, double from_mm, double to_mm, double sign) {
  const Profile range = part(profile, from_mm, to_mm);
  if (range.size() < 6) return std::nullopt;
  const auto best = std::ranges::max_element(
      range, [&](const ProfilePoint& a, const ProfilePoint& b) { return sign * a.z_mm < sign * b.z_mm; });
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
  const double from = tip.y_mm + kChinTo, fold_from = from + 20, fold_to = tip.y_mm + kChinFrom + 10;
  auto fold = extreme(profile, fold_from, fold_to, -1);
  // Where the throat lies behind it, it is only the deepest below the hull.
  if (!fold)
    if (const Deepest d = deepest_below_hull(profile, from, fold_to, fold_from, fold_to);
        d.depth_mm > kChinRise)
      fold = d.at;
  const double to = fold ? fold->y_mm : tip.y_mm + kChinFrom;
  const auto chin = extreme(profile, from, to, 1);
  if (!chin || (fold && chin->z_mm < fold->z_mm + kChinRise)) return std::nullopt;
  const auto lower = below_lip(profile, from, *chin);
  return lower ? lower : chin;
}

}  // namespace

FaceCore face_core(const FaceMesh& mesh, const RigidTransform& head_from_camera, StageContext& context) {
  const Arena::Mark mark(context.scratch);
  const ReliefBox box{-kCoreHalf, kCoreHalf, kCoreFrom - 5, kCoreTo + 5, kCoreCell};
  FaceRelief core(box, &context.scratch),
      nose(box, &context.scratch);  // below the tip nothing may be certain
  FaceRelief::add_both(mesh, head_from_camera, core, nose, context);
  const Vector3d tip = tip_of(nose);
  core.symmetrise();
  return {nod_of(core), tip};
}

std::pmr::vector<ProfilePoint> profile_of(const FaceMesh& mesh, const RigidTransform& frame_from_mesh,
                                          std::pmr::memory_resource* memory, bool completed_too) {
  constexpr double kHalfWidth = 6 * kCellMm;
  FaceRelief band({-kHalfWidth, kHalfWidth, -kBelowMm, kAboveMm, kCellMm}, memory);
  band.add(mesh, frame_from_mesh, completed_too);
  band.symmetrise();
  band.smooth(kSmoothMm, memory);
  std::pmr::vector<ProfilePoint> profile(memory);
  profile.reserve(std::size_t(band.rows()));
  for (int row = 0; row < band.rows(); ++row)
    if (const float z = band.z(band.columns() / 2, row); !std::isnan(z))
      profile.push_back({band.y_mm(row), double(z)});
  return profile;
}

ProfileMarks find_profile_marks(Profile profile) {
  ProfileMarks marks;
  marks.tip = extreme(profile, -kTipReachMm, kTipReachMm, 1);
  if (!marks.tip) return marks;
  marks.nasion = find_nasion(profile, *marks.tip);
  marks.chin = find_chin(profile, *marks.tip);
  if (!marks.chin) {
    const ProfilePoint& tip = *marks.tip;
    const Profile range = part(profile, tip.y_mm + kChinTo, tip.y_mm + kRecedingFrom);
    const auto touched = std::ranges::min_element(
        range, {}, [&](const ProfilePoint& p) { return (tip.z_mm - p.z_mm) / (tip.y_mm - p.y_mm); });
    marks.chin_recedes = range.size() >= 6 && touched != range.begin() && touched + 1 != range.end();
    if (marks.chin_recedes) marks.chin = *touched;
  }
  const Deepest base = deepest_below_hull(profile, marks.tip->y_mm - kLipFoot, marks.tip->y_mm,
                                          marks.tip->y_mm - kLipFoot, marks.tip->y_mm - 3);
  if (base.depth_mm >= kSubnasaleDepth) marks.subnasale = base.at;
  return marks;
}

}  // namespace relievo::pipeline
