// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/recognition/face_comparison.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace relievo::pipeline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kFewestPoints = 400;
constexpr double kFewestShared = 0.35;       // of the smaller face: less is no comparison
constexpr double kKept = 0.9;                // of the pairs: the rest is hair, lids, expression
constexpr double kBesideMm = 2.5;            // a counterpart further along the surface is another place
constexpr double kReachMm = 12;              // along the normal
constexpr double kAlike = 0.6;               // cosine between the normals
constexpr std::size_t kWhileMoving = 700;    // points of each face until the motion settles
constexpr std::size_t kToSettle = 1U << 20;  // all
constexpr int kTurns = 30;

struct Motion {  // b = turn * a + shift
  Matrix3d turn = Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
};

// A distance along a normal, and its slope by a small turn and shift of the moved face.
struct Pair {
  double distance = 0;
  Vector6d slope;
};

Vector3d to_eigen(const Vec3f& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// From the points of `from`, moved, to the surface of `to`. Returns how many were asked.
template <typename Take>
std::size_t meet(const RigidFace& from, const ComparableFace& to, const Motion& to_from_from,
                 std::size_t every, Take&& take) {
  std::size_t asked = 0;
  for (std::size_t i = 0; i < from.points_mm.size(); i += every, ++asked) {
    const Vector3d p = to_from_from.turn * to_eigen(from.points_mm[i]) + to_from_from.shift;
    const std::uint32_t k = to.tree().nearest({p.x(), p.y(), p.z()});
    if (to.face().rim[k] != 0) continue;
    const Vector3d n = to_eigen(to.face().normals[k]), d = p - to_eigen(to.face().points_mm[k]);
    const double r = n.dot(d);
    if (std::abs(r) > kReachMm || (d - r * n).squaredNorm() > kBesideMm * kBesideMm) continue;
    if (n.dot(to_from_from.turn * to_eigen(from.normals[i])) < kAlike) continue;
    take(p, n, r);
  }
  return asked;
}

struct Meeting {
  std::vector<Pair> pairs;
  double shared = 0;
};

// Both ways: a's points on b, and b's on a, whose motion is the inverse.
void meet_both(const ComparableFace& a, const ComparableFace& b, const Motion& m, std::size_t wanted,
               Meeting& out) {
  out.pairs.clear();
  const auto every = [&](const ComparableFace& f) {
    return std::max<std::size_t>(1, f.face().points_mm.size() / wanted);
  };
  const std::size_t of_a =
      meet(a.face(), b, m, every(a), [&](const Vector3d& p, const Vector3d& n, double r) {
        Pair pair{r, {}};
        pair.slope << p.cross(n), n;
        out.pairs.push_back(pair);
      });
  const std::size_t met = out.pairs.size();
  const Motion back{m.turn.transpose(), -(m.turn.transpose() * m.shift)};
  const std::size_t of_b =
      meet(b.face(), a, back, every(b), [&](const Vector3d& p, const Vector3d& n, double r) {
        const Vector3d turned = m.turn * n,
                       at = m.turn * p + m.shift;  // in b's frame, where the motion is corrected
        Pair pair{r, {}};
        pair.slope << -at.cross(turned), -turned;
        out.pairs.push_back(pair);
      });
  const auto share = [](std::size_t part, std::size_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  };
  out.shared = std::min(share(met, of_a), share(out.pairs.size() - met, of_b));
}

// Leaves the kept pairs in front; their order is not the points' order, but always the same.
std::size_t trim(std::vector<Pair>& pairs) {
  const auto kept = static_cast<std::size_t>(kKept * static_cast<double>(pairs.size()));
  std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(kept), pairs.end(),
                   [](const Pair& l, const Pair& r) { return std::abs(l.distance) < std::abs(r.distance); });
  return kept;
}

// One step of Gauss and Newton. Returns how far it went, in mm at the rim of a face.
double correct(Meeting& meeting, Motion& m) {
  const std::size_t kept = trim(meeting.pairs);
  Matrix6d a = Matrix6d::Identity() * 1e-6;
  Vector6d b = Vector6d::Zero();
  for (std::size_t i = 0; i < kept; ++i) {
    a += meeting.pairs[i].slope * meeting.pairs[i].slope.transpose();
    b -= meeting.pairs[i].slope * meeting.pairs[i].distance;
  }
  const Vector6d step = a.ldlt().solve(b);
  const Vector3d turn = step.head<3>();
  const double angle = turn.norm();
  const Matrix3d by =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3d(Matrix3d::Identity());
  m = {by * m.turn, by * m.shift + step.tail<3>()};
  return 80 * angle + step.tail<3>().norm();
}

RigidTransform to_transform(const Motion& m) {
  RigidTransform t;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) t.rotation.m[3 * r + c] = m.turn(r, c);
  t.translation_mm = {m.shift.x(), m.shift.y(), m.shift.z()};
  return t;
}

}  // namespace

Result<ComparableFace> ComparableFace::make(RigidFace face) {
  if (face.points_mm.size() < kFewestPoints)
    return Error{Errc::PoorGeometry,
                 "too little of nose, brow and cheekbones was measured to compare this face"};
  NearestPoints tree(face.points_mm);
  return ComparableFace(std::move(face), std::move(tree));
}

Result<FaceDifference> compare_faces(const ComparableFace& a, const ComparableFace& b) {
  const Error apart{Errc::PoorGeometry, "the two faces show too little of the same places to be compared"};
  Motion motion;
  Meeting meeting;
  meeting.pairs.reserve(a.face().points_mm.size() + b.face().points_mm.size());
  for (int turn = 0; turn <= kTurns; ++turn) {
    meet_both(a, b, motion, turn < kTurns ? kWhileMoving : kToSettle, meeting);
    if (meeting.pairs.size() < 100) return apart;
    if (correct(meeting, motion) < 0.005 && turn < kTurns) turn = kTurns - 1;  // once more with all
  }
  meet_both(a, b, motion, kToSettle, meeting);
  if (meeting.shared < kFewestShared) return apart;
  const std::size_t kept = trim(meeting.pairs);
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += meeting.pairs[i].distance * meeting.pairs[i].distance;
  return FaceDifference{std::sqrt(sum / static_cast<double>(kept)), meeting.shared, to_transform(motion)};
}

}  // namespace relievo::pipeline
