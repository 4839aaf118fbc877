// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reconstruct/triangulators.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "pipeline/base/solving.h"

namespace relievo::pipeline {
namespace {

// In the rectified frame.
struct Placed {
  Vec3d at_mm;
  double stretch;  // of the line of sight: its length over its depth
};

// `place` says where a match lies. Sigma along the line of sight follows from the disparity's.
template <typename Place>
Result<PointCloud> place_matches(const RectifiedPair& pair, const MatchSet& matches, StageContext& context,
                                 const Place& place) {
  const auto accepted = std::size_t(
      std::ranges::count_if(matches.matches, [](const Match& match) { return match.rejected_by == 0; }));
  if (accepted < 3)
    return Error{Errc::TooFewMatches, "every match was rejected: loosen the constraints or capture again"};
  PointCloud cloud(&context.output);
  cloud.lattice_step_px = matches.lattice_step_px;
  cloud.right_camera_mm = pair.right_camera_mm();
  cloud.points.reserve(accepted);
  const Rotation left_from_rectified = transposed(pair.rectified_from_left);
  for (std::size_t k = 0; k < matches.matches.size(); ++k) {
    if (k % 16384 == 0 && context.stop()) return stopped();
    const Match& match = matches.matches[k];
    if (match.rejected_by != 0) continue;
    const Placed placed = place(match);
    const double z = placed.at_mm.z;
    if (!(z >= pair.near_mm && z <= pair.far_mm)) continue;  // outside the volume: not this person
    const Vec3d p = apply(left_from_rectified, placed.at_mm);
    const double along = placed.stretch * z * z / (pair.focal_px * pair.baseline_mm);
    cloud.points.push_back(
        {{float(p.x), float(p.y), float(p.z)}, match.left_px, float(along * double(match.sigma_px))});
  }
  if (cloud.points.size() < 3)
    return Error{Errc::TooFewMatches,
                 "nothing lies between the near and far limits: stand closer to the marked distance"};
  return cloud;
}

// The right camera stands at (B, 0, 0) of the rectified frame: with l and r the lines of sight there,
// (e_x cross l) . r = 0, and each is its own camera's place turned into the rectified frame.
EpipolarRelation relation_of(const Rotation& a, const Rotation& b) {
  EpipolarRelation relation{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) relation.m[3 * i + j] = a.m[3 + i] * b.m[6 + j] - a.m[6 + i] * b.m[3 + j];
  return relation;
}

Vec2d on_plane(const Vec3d& direction) { return {direction.x / direction.z, direction.y / direction.z}; }

double squares(const PlacePair& s) {
  return s.left.x * s.left.x + s.left.y * s.left.y + s.right.x * s.right.x + s.right.y * s.right.y;
}

}  // namespace

Result<PointCloud> InverseDisparityTriangulator::triangulate(const RectifiedPair& pair,
                                                             const MatchSet& matches,
                                                             StageContext& context) const {
  return place_matches(pair, matches, context, [&](const Match& match) {
    const double z = pair.depth_mm(match.disparity_px);
    const double u = (match.left_px.x - pair.left_centre_px.x) / pair.focal_px;
    const double v = (match.left_px.y - pair.left_centre_px.y) / pair.focal_px;
    return Placed{{u * z, v * z, z}, std::sqrt(1 + u * u + v * v)};
  });
}

Result<PointCloud> LinearTriangulator::triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                                   StageContext& context) const {
  const Eigen::Vector3d centre(pair.baseline_mm, 0, 0);  // of the right camera, rectified frame
  return place_matches(pair, matches, context, [&](const Match& match) {
    const double f = pair.focal_px;
    const Eigen::Vector3d left((match.left_px.x - pair.left_centre_px.x) / f,
                               (match.left_px.y - pair.left_centre_px.y) / f, 1);
    const Eigen::Vector3d right((match.left_px.x - match.disparity_px - pair.right_centre_px.x) / f,
                                (match.left_px.y - pair.right_centre_px.y) / f, 1);
    Eigen::Matrix<double, 6, 5> system = Eigen::Matrix<double, 6, 5>::Zero();
    Eigen::Matrix<double, 6, 1> known = Eigen::Matrix<double, 6, 1>::Zero();
    system.topLeftCorner<3, 3>().setIdentity();
    system.bottomLeftCorner<3, 3>().setIdentity();
    system.block<3, 1>(0, 3) = -left;
    system.block<3, 1>(3, 4) = -right;
    known.tail<3>() = centre;
    const Eigen::Matrix<double, 5, 1> solution =
        solved<5>(system.transpose() * system, system.transpose() * known);
    return Placed{{solution(0), solution(1), solution(2)}, left.norm()};
  });
}

PlacePair correct_optimally(const EpipolarRelation& e, const PlacePair& seen) {
  const double* m = e.m;
  const Vec2d& l = seen.left;
  const Vec2d& r = seen.right;
  PlacePair n{{m[0] * r.x + m[1] * r.y + m[2], m[3] * r.x + m[4] * r.y + m[5]},
              {m[0] * l.x + m[3] * l.y + m[6], m[1] * l.x + m[4] * l.y + m[7]}};
  const auto inner = [&](const Vec2d& p, const Vec2d& q) {
    return p.x * (m[0] * q.x + m[1] * q.y) + p.y * (m[3] * q.x + m[4] * q.y);
  };
  const double a = inner(n.left, n.right);
  const double b = 0.5 * squares(n);
  const double c = l.x * n.left.x + l.y * n.left.y + m[6] * r.x + m[7] * r.y + m[8];
  const double d = std::sqrt(std::max(0.0, b * b - a * c));
  if (!(b + d > 0)) return seen;  // at an epipole every line of sight meets
  const double first = c / (b + d);
  const Vec2d move_left{first * n.left.x, first * n.left.y};
  const Vec2d move_right{first * n.right.x, first * n.right.y};
  n.left = {n.left.x - m[0] * move_right.x - m[1] * move_right.y,
            n.left.y - m[3] * move_right.x - m[4] * move_right.y};
  n.right = {n.right.x - m[0] * move_left.x - m[3] * move_left.y,
             n.right.y - m[1] * move_left.x - m[4] * move_left.y};
  const double norm = squares(n);
  if (!(norm > 0)) return seen;
  const double second = first * 2 * d / norm;
  return {{l.x - second * n.left.x, l.y - second * n.left.y},
          {r.x - second * n.right.x, r.y - second * n.right.y}};
}

Result<PointCloud> OptimalTriangulator::triangulate(const RectifiedPair& pair, const MatchSet& matches,
                                                    StageContext& context) const {
  const EpipolarRelation relation = relation_of(pair.rectified_from_left, pair.rectified_from_right);
  const Rotation left_from_rectified = transposed(pair.rectified_from_left),
                 right_from_rectified = transposed(pair.rectified_from_right);
  const double f = pair.focal_px;
  return place_matches(pair, matches, context, [&](const Match& match) {
    const Vec3d left{(match.left_px.x - pair.left_centre_px.x) / f,
                     (match.left_px.y - pair.left_centre_px.y) / f, 1};
    const double column =
        double(match.left_px.x) - double(match.disparity_px);  // the shift is the right view's
    const double row =
        double(match.left_px.y) +
        (matches.epipolar_shift.measured() ? matches.epipolar_shift.at(column, double(match.left_px.y)) : 0);
    const Vec3d right{(match.left_px.x - match.disparity_px - pair.right_centre_px.x) / f,
                      (row - pair.right_centre_px.y) / f, 1};
    const PlacePair moved = correct_optimally(
        relation, {on_plane(apply(left_from_rectified, left)), on_plane(apply(right_from_rectified, right))});
    // The lines meet now: the rectified disparity of the moved places is exact.
    const Vec2d u = on_plane(apply(pair.rectified_from_left, {moved.left.x, moved.left.y, 1}));
    const Vec2d v = on_plane(apply(pair.rectified_from_right, {moved.right.x, moved.right.y, 1}));
    const double z = pair.baseline_mm / (u.x - v.x);
    return Placed{{u.x * z, u.y * z, z}, std::sqrt(1 + u.x * u.x + u.y * u.y)};
  });
}

}  // namespace relievo::pipeline
