// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/match/region/face_reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/QR>

#include "pipeline/model/vector3.h"

namespace relievo::pipeline {

void ThreeTerms::add(const std::array<double, 3>& terms, double value, double weight) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) products_[at++] += weight * terms[i] * terms[j];
    values_[i] += weight * terms[i] * value;
  }
}

std::optional<std::array<double, 3>> ThreeTerms::solve() const {
  const auto& p = products_;
  Eigen::Matrix3d a;
  a << p[0], p[1], p[2], p[1], p[3], p[4], p[2], p[4], p[5];
  const Eigen::ColPivHouseholderQR<Eigen::Matrix3d> qr(a);
  if (!qr.isInvertible()) return std::nullopt;
  const Eigen::Vector3d k = qr.solve(Eigen::Vector3d(values_[0], values_[1], values_[2]));
  return std::array<double, 3>{k[0], k[1], k[2]};
}

namespace {

constexpr double kNearest = 0.01;
constexpr std::size_t kLeast = 50;  // nodes in the middle; of fewer nothing can be said
constexpr double kLongestNoseMm = 60;
constexpr double kNoseDown = 0.12;  // of the face's width, from the middle of its box

// Depth over the middle's plane: level + right * x + down * y, about the points' mean.
struct Plane3 {
  Vec3d mean;
  double level = 0, right = 0, down = 0;
  double before(const Vec3d& p) const {
    return mean.z + level + right * (p.x - mean.x) + down * (p.y - mean.y) - p.z;
  }
};

// Least squares, then five times more with what lies off it (the nose) counting little (Geman-McClure).
Plane3 plane_of(std::span<const Vec3d> points) {
  constexpr double kScale = 6;       // mm: a face without its nose is about that flat
  constexpr double kSteepest = 1.2;  // 50 degrees: the few points of a poor picture may say anything
  Plane3 plane;
  for (const Vec3d& p : points) plane.mean = plus(plane.mean, p);
  const auto count = double(points.size());
  plane.mean.x /= count, plane.mean.y /= count, plane.mean.z /= count;
  for (int round = 0; round < 6; ++round) {
    ThreeTerms terms;
    for (const Vec3d& p : points) {
      const double e = round == 0 ? 0 : plane.before(p) / kScale;
      terms.add({1, p.x - plane.mean.x, p.y - plane.mean.y}, p.z - plane.mean.z,
                1 / ((1 + e * e) * (1 + e * e)));
    }
    const auto k = terms.solve();
    if (!k) break;  // all on a line: what is nearest, then
    plane.level = (*k)[0];
    plane.right = std::clamp((*k)[1], -kSteepest, kSteepest);
    plane.down = std::clamp((*k)[2], -kSteepest, kSteepest);
  }
  return plane;
}

// The mean of the hundredth of points that comes first.
template <typename Before>
Vec3d mean_of_first(std::span<Vec3d> middle, Before&& before) {
  const auto count = std::max<std::size_t>(10, std::size_t(kNearest * double(middle.size())));
  const std::span<Vec3d> nearest = middle.first(std::min(count, middle.size()));
  std::nth_element(middle.begin(), middle.begin() + std::ptrdiff_t(nearest.size() - 1), middle.end(), before);
  const auto share = double(nearest.size());
  Vec3d tip;
  for (const Vec3d& p : nearest) tip = plus(tip, {p.x / share, p.y / share, p.z / share});
  return tip;
}

}  // namespace

Vec3d outstanding_tip(std::span<Vec3d> middle) { return outstanding_tip(middle, middle.size()); }

Vec3d outstanding_tip(std::span<Vec3d> middle, std::size_t candidates) {
  const Plane3 plane = plane_of(middle);
  // What stands out further than any nose is a false match.
  const auto begin = middle.begin();
  const auto end = std::partition(begin, begin + std::ptrdiff_t(candidates),
                                  [&](const Vec3d& p) { return plane.before(p) < kLongestNoseMm; });
  if (end - begin >= 10) candidates = std::size_t(end - begin);
  return mean_of_first(middle.first(candidates),
                       [&](const Vec3d& a, const Vec3d& b) { return plane.before(a) > plane.before(b); });
}

bool may_be_nose(const RectifiedPair& pair, double x_px, double y_px) {
  return std::hypot(x_px - pair.face_centre_px.x,
                    y_px - pair.face_centre_px.y - kNoseDown * pair.face_width_px) <
         kNoseReach * pair.face_width_px;
}

void keep_within_reach(const RectifiedPair& pair, StageContext& context, SurfaceField& field) {
  if (!(pair.face_reach_mm > 0 && pair.face_width_px > 0)) return;
  Arena::Mark mark(context.scratch);
  const auto point = [&](int i, int j) {
    const double z = pair.depth_mm(double(field.disparity_px.row(j)[i]));
    return Vec3d{(i * field.step_px - pair.left_centre_px.x) * z / pair.focal_px,
                 (j * field.step_px - pair.left_centre_px.y) * z / pair.focal_px, z};
  };
  std::pmr::vector<Vec3d> middle(&context.scratch);
  middle.reserve(field.domain.values.size());
  for (int j = 0; j < field.domain.height; ++j)
    for (int i = 0; i < field.domain.width; ++i)
      if (field.domain.row(j)[i] != 0 && may_be_nose(pair, i * field.step_px, j * field.step_px))
        middle.push_back(point(i, j));
  if (middle.size() < kLeast) return;
  const Vec3d tip = outstanding_tip(middle);
  const double reach2 = pair.face_reach_mm * pair.face_reach_mm;
  for (int j = 0; j < field.domain.height; ++j)
    for (int i = 0; i < field.domain.width; ++i)
      if (field.domain.row(j)[i] != 0 && !(squared_distance(point(i, j), tip) <= reach2))
        field.domain.row(j)[i] = 0;
}

}  // namespace relievo::pipeline
