// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/head_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "hal/base/statistics.h"
#include "pipeline/mesh/landmarks/face_profile.h"
#include "pipeline/mesh/landmarks/symmetry_plane.h"

namespace relievo::pipeline {
namespace {

// Where a surface stands out of its surroundings as a nose does, whichever way it is turned
// (cf. Xu, Wang, Tan, Quan, AMFG 2006: local convexity finds noses before pose is known).

struct NoseCandidate {
  Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
  double protrusion_mm = 0;  // how far the ring 18 to 28 mm around lies behind, on average; noses 8 to 16
};

constexpr std::size_t kMostNoses = 4;
using NoseCandidates = std::pmr::vector<NoseCandidate>;  // falling protrusion, at least 25 mm apart

using Eigen::Vector3d;

constexpr double kRingFrom = 18, kRingTo = 28;  // mm; beyond the wings of a nose, within its cheeks
constexpr int kSectors = 8;
constexpr int kSectorsNeeded = 5;  // one flank of the nose may hide its cheek

// Negative where the surroundings cannot be judged.
double protrusion(std::span<const SurfacePoint> points, const Vector3d& at) {
  Vector3d out = Vector3d::Zero();
  for (const SurfacePoint& q : points)
    if ((q.at_mm - at).squaredNorm() < 12.0 * 12.0) out += q.normal;
  if (!(out.norm() > 0)) return -1;
  out.normalize();
  const Vector3d across =
      (std::abs(out.x()) < 0.8 ? Vector3d::UnitX() : Vector3d::UnitY()).cross(out).normalized();
  const Vector3d along = out.cross(across);
  std::array<double, kSectors> sum{};
  std::array<int, kSectors> count{};
  for (const SurfacePoint& q : points) {
    const Vector3d d = q.at_mm - at;
    const double u = d.dot(across);
    const double v = d.dot(along);
    const double ring = u * u + v * v;
    const double behind = -d.dot(out);
    if (ring < kRingFrom * kRingFrom || ring > kRingTo * kRingTo || std::abs(behind) > 50) continue;
    const double turn = (std::atan2(v, u) / std::numbers::pi + 1) / 2;
    const auto k = std::size_t(std::clamp(int(turn * kSectors), 0, kSectors - 1));
    sum[k] += behind;
    ++count[k];
  }
  double mean = 0;
  int sectors = 0;
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (count[k] < 3) continue;
    mean += sum[k] / count[k];
    ++sectors;
  }
  return sectors < kSectorsNeeded ? -1 : mean / sectors;
}

void keep(NoseCandidates& found, const NoseCandidate& candidate) {
  const auto near = [&](const NoseCandidate& c) { return (c.at_mm - candidate.at_mm).norm() <= 25; };
  const auto better = [&](const NoseCandidate& c) { return c.protrusion_mm >= candidate.protrusion_mm; };
  if (std::ranges::any_of(found, [&](const NoseCandidate& c) { return near(c) && better(c); })) return;
  std::erase_if(found, near);
  found.insert(std::ranges::partition_point(found, better), candidate);
  if (found.size() > kMostNoses) found.pop_back();
}

// Any frame. Places at the rim of the surface, whose ring is not closed, do not stand as candidates.
NoseCandidates find_nose_candidates(std::span<const SurfacePoint> points, StageContext& context) {
  const std::size_t every = std::max<std::size_t>(1, points.size() / 1000);
  std::pmr::vector<double> protrusions((points.size() + every - 1) / every, -1.0, &context.scratch);
  context.pool.for_each<std::size_t>(int(protrusions.size()), 16, [&](std::size_t i) {
    protrusions[i] = protrusion(points, points[i * every].at_mm);
  });
  NoseCandidates found(&context.scratch);
  found.reserve(kMostNoses + 1);
  for (std::size_t i = 0; i < protrusions.size(); ++i)
    if (protrusions[i] > 3) keep(found, {points[i * every].at_mm, protrusions[i]});
  return found;
}

using Eigen::Matrix3d;
using Points = std::pmr::vector<SurfacePoint>;

struct Frame {  // head = rows * (camera - origin)
  Matrix3d rows = Matrix3d::Identity();
  Vector3d origin = Vector3d::Zero();
};

Vector3d to_eigen(const Vec3f& v) { return {double(v.x), double(v.y), double(v.z)}; }

// Evenly by area: where the lattice is seen at a slant its points lie far apart and count for more.
Points sample(const FaceMesh& mesh, int wanted, Arena& scratch) {
  double total = 0;
  const auto area = [&](const auto& t) {
    const Vector3d a = to_eigen(mesh.vertices_mm[t[0]]);
    return 0.5 * (to_eigen(mesh.vertices_mm[t[1]]) - a).cross(to_eigen(mesh.vertices_mm[t[2]]) - a).norm();
  };
  for (const auto& t : mesh.triangles)
    if (all_three(mesh.measured, t)) total += area(t);
  Points points(&scratch);
  if (!(total > 0)) return points;
  points.reserve(std::size_t(wanted) + 1);
  double due = 0;
  for (const auto& t : mesh.triangles) {
    if (!all_three(mesh.measured, t)) continue;
    due += area(t) * wanted / total;
    if (due < 1 || points.size() >= std::size_t(wanted)) continue;
    due -= std::floor(due);
    SurfacePoint p;
    for (const std::uint32_t v : t) {
      p.at_mm += to_eigen(mesh.vertices_mm[v]) / 3;
      p.normal += to_eigen(mesh.normals[v]);
    }
    p.normal.normalize();
    points.push_back(p);
  }
  return points;
}

constexpr int kSamplePoints = 6000;  // of the surface, that vote on the frame
constexpr int kSettlingPoints = 24000, kSettlingRounds = 2;
constexpr double kSettlingReach = 70;  // mm around the tip: less of a jaw that is pulled aside
constexpr double kHalfFace = 80;  // mm around the tip of the nose: forehead to chin, cheek to cheek, no neck

constexpr double kWorthOfProtrusion = 0.2;  // mm of mirror cost, a mm: half a nose is a poor mirror
constexpr double kCostOfOneSide = 2;  // mm: a chin may stand out further than a nose, seen from the neck
constexpr double kMostOfANose = 16;   // mm: what stands out further is no better nose, but hair

constexpr double kOneNose = 40;       // mm: places of one and the same
constexpr double kWorthOfTheTip = 1;  // mm of mirror cost

// Points near `centre`, still in the frame of `points`.
Points around(const Points& points, const Vector3d& centre, double reach, Arena& scratch) {
  Points near(&scratch);
  near.reserve(points.size());
  for (const SurfacePoint& p : points)
    if ((p.at_mm - centre).squaredNorm() < reach * reach) near.push_back(p);
  return near;
}

// Out of the face: the mean normal.
Frame first_guess(const Points& points, const Vector3d& origin, const Vector3d& across) {
  Vector3d out = Vector3d::Zero();
  for (const SurfacePoint& p : points) out += p.normal;
  Frame frame;
  frame.origin = origin;
  const Vector3d z = out.normalized();
  const Vector3d y = z.cross(across).normalized();
  frame.rows.row(0) = y.cross(z);
  frame.rows.row(1) = y;
  frame.rows.row(2) = z;
  return frame;
}

void move_into(Points& points, const Frame& frame) {
  for (SurfacePoint& p : points) {
    p.at_mm = frame.rows * (p.at_mm - frame.origin);
    p.normal = frame.rows * p.normal;
  }
}

// `second` is given in the coordinates that `first` leads to.
Frame chained(const Frame& first, const Frame& second) {
  return {second.rows * first.rows, first.origin + first.rows.transpose() * second.origin};
}

double extent(std::span<const SurfacePoint> points, int axis, Arena& scratch) {
  std::pmr::vector<double> values(&scratch);
  values.reserve(points.size());
  for (const SurfacePoint& p : points) values.push_back(p.at_mm[axis]);
  return percentile(values, 0.99) - percentile(values, 0.01);
}

double relief_of(std::span<const SurfacePoint> points) {
  double sum[2] = {0, 0};
  double count[2] = {0, 0};
  for (const SurfacePoint& p : points) {
    const double x = std::abs(p.at_mm.x());
    if (x < 28 || x > 40 || std::abs(p.at_mm.y()) > 10 || p.at_mm.z() < -70) continue;
    const std::size_t side = p.at_mm.x() > 0 ? 1 : 0;
    sum[side] += p.at_mm.z();
    count[side] += 1;
  }
  const double sides = (count[0] > 0 ? 1 : 0) + (count[1] > 0 ? 1 : 0);
  if (sides < 1) return 0;
  return -((count[0] > 0 ? sum[0] / count[0] : 0) + (count[1] > 0 ? sum[1] / count[1] : 0)) / sides;
}

RigidTransform to_transform(const Frame& frame) {
  RigidTransform t;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) t.rotation.m[3 * r + c] = frame.rows(r, c);
  const Vector3d shift = -(frame.rows * frame.origin);
  t.translation_mm = {shift.x(), shift.y(), shift.z()};
  return t;
}

// How one-sided the surface around the origin is, 0 as around a nose to 1: a chin has a face above it and
// next to nothing below, a forehead the other way round. y is up to some tens of degrees.
double one_sidedness(std::span<const SurfacePoint> points) {
  constexpr double kBeside = 15;      // mm: the place itself is on neither side
  constexpr double kBalanced = 0.25;  // a nose has at least so much of its face below it, and above
  double above = 0;
  double below = 0;
  for (const SurfacePoint& p : points) {
    above += p.at_mm.y() > kBeside ? 1 : 0;
    below += p.at_mm.y() < -kBeside ? 1 : 0;
  }
  if (!(above + below > 0)) return 1;
  return std::max(0.0, 1 - std::min(above, below) / (above + below) / kBalanced);
}

// The nod stays about what it was.
Frame upright_on(const SymmetryPlane& plane) {
  Frame upright;
  upright.rows.row(0) = plane.normal;
  upright.rows.row(1) = Vector3d::UnitZ().cross(plane.normal).normalized();
  upright.rows.row(2) = plane.normal.cross(upright.rows.row(1).transpose());
  upright.origin = plane.offset_mm * plane.normal;
  return upright;
}

// The frame of the most mirror-like face around one of the places that stand out like a nose: x is
// final, the origin is near the tip, the nod is a guess.
Result<Frame> upright_frame(const Points& points, const Vector3d& across, SymmetryPlane& best,
                            StageContext& context) {
  Error why{Errc::PoorGeometry,
            "nothing on the surface stands out like a nose: look straight into the cameras"};
  double best_score = 1e9;
  Frame frame;
  const NoseCandidates noses = find_nose_candidates(points, context);
  std::size_t chosen = noses.size();
  for (std::size_t i = 0; i < noses.size(); ++i) {
    Points face = around(points, noses[i].at_mm, kHalfFace, context.scratch);
    const Frame guess = first_guess(face, noses[i].at_mm, across);
    move_into(face, guess);
    const double one_sided = one_sidedness(face);
    const Result<SymmetryPlane> plane = find_symmetry_plane(face, context);
    if (!plane) {
      if (plane.error().code == Errc::Cancelled) return plane.error();
      why = plane.error();
      continue;
    }
    // A nose stands out three times as far as anything else on a head that is mirror-like.
    const double score = plane->cost_mm -
                         kWorthOfProtrusion * std::min(noses[i].protrusion_mm, kMostOfANose) +
                         kCostOfOneSide * one_sided;
    // The bridge of a nose is as good a mirror as its tip, which stands out further and came first.
    const bool same_nose = chosen < i && (noses[i].at_mm - noses[chosen].at_mm).norm() < kOneNose;
    if (score >= best_score - (same_nose ? kWorthOfTheTip : 0)) continue;
    best_score = score;
    chosen = i;
    best = *plane;
    frame = chained(guess, upright_on(*plane));
  }
  if (best_score > 1e8) return why;
  return frame;
}

void move(Frame& frame, Points& points, const Frame& step) {
  frame = chained(frame, step);
  move_into(points, step);
}

void turn(Frame& frame, Points& points, double nod_rad) {
  Frame turned;
  turned.rows = Eigen::AngleAxisd(nod_rad, Vector3d::UnitX()).toRotationMatrix().transpose();
  move(frame, points, turned);
}

Result<void> set_upright(const FaceMesh& mesh, Frame& frame, Points& points, StageContext& context) {
  constexpr double kFurthest = 25;  // mm from the candidate: further on lies the chin, where this would walk
                                    // along a nose that is missing
  const Vector3d start = frame.origin;
  for (int round = 0; round < 8; ++round) {
    if (context.stop()) return stopped();
    const FaceCore core = face_core(mesh, to_transform(frame), context);
    Frame tip;
    tip.origin = core.tip;
    if ((chained(frame, tip).origin - start).norm() < kFurthest) move(frame, points, tip);
    turn(frame, points, core.nod_rad);
    if (core.tip.norm() < 1e-2 && std::abs(core.nod_rad) < 1e-4) break;
  }
  return {};
}

// Which points were drawn, and which of them came to be the first guess of the tip, must not matter: many
// more of them, about the tip itself, have the last word on the plane.
Result<void> settle(const FaceMesh& mesh, Frame& frame, Points& points, StageContext& context) {
  const Points all = sample(mesh, kSettlingPoints, context.scratch);
  for (int round = 0; round < kSettlingRounds; ++round) {
    Points face = around(all, frame.origin, kSettlingReach, context.scratch);
    move_into(face, frame);
    move(frame, points, upright_on(settle_symmetry_plane(face, context.scratch)));
    RELIEVO_TRY(set_upright(mesh, frame, points, context));
  }
  return {};
}

// `points` in the frame already.
HeadFrame measured(const Points& points, const Frame& frame, StageContext& context) {
  HeadFrame head;
  head.head_from_camera = to_transform(frame);
  head.width_mm = extent(points, 0, context.scratch);
  head.height_mm = extent(points, 1, context.scratch);
  return head;
}

}  // namespace

Result<HeadFrame> find_head_frame(const FaceMesh& mesh, StageContext& context, const Vec3d& across) {
  if (context.stop()) return stopped();
  Points points = sample(mesh, kSamplePoints, context.scratch);
  if (points.size() < 400)
    return Error{Errc::PoorGeometry, "too little measured surface to tell how the head is turned"};

  SymmetryPlane plane;
  RELIEVO_TRY_ASSIGN(Frame frame, upright_frame(points, {across.x, across.y, across.z}, plane, context));
  move_into(points, frame);

  RELIEVO_TRY(set_upright(mesh, frame, points, context));
  RELIEVO_TRY(settle(mesh, frame, points, context));

  HeadFrame head = measured(points, frame, context);
  head.nose_relief_mm = relief_of(points);
  head.asymmetry_mm = plane.residual_mm;
  return head;
}

HeadFrame frame_as_seen(const FaceMesh& mesh, StageContext& context) {
  Frame frame;
  frame.rows = Vector3d(1, -1, -1).asDiagonal();
  Points points = sample(mesh, kSamplePoints, context.scratch);
  if (points.empty()) return {to_transform(frame)};
  for (const SurfacePoint& p : points) frame.origin += p.at_mm / double(points.size());
  move_into(points, frame);
  return measured(points, frame, context);
}

}  // namespace relievo::pipeline
