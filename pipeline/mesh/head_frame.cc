// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/head_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "pipeline/mesh/nose_tip.h"
#include "pipeline/mesh/symmetry_plane.h"

namespace relievo::pipeline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::pmr::vector<SurfacePoint>;

struct Frame {  // head = rows * (camera - origin)
  Matrix3d rows = Matrix3d::Identity();
  Vector3d origin = Vector3d::Zero();
};

Vector3d to_eigen(const Vec3f& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Evenly by area: where the lattice is seen at a slant its points lie far apart and count for more.
Points sample(const FaceMesh& mesh, int wanted, Arena& scratch) {
  double total = 0;
  const auto area = [&](const auto& t) {
    const Vector3d a = to_eigen(mesh.vertices_mm[t[0]]);
    return 0.5 * (to_eigen(mesh.vertices_mm[t[1]]) - a).cross(to_eigen(mesh.vertices_mm[t[2]]) - a).norm();
  };
  const auto counts = [&](const auto& t) { return mesh.measured[t[0]] && mesh.measured[t[1]] && mesh.measured[t[2]]; };
  for (const auto& t : mesh.triangles)
    if (counts(t)) total += area(t);
  Points points(&scratch);
  if (!(total > 0)) return points;
  points.reserve(static_cast<std::size_t>(wanted) + 1);
  double due = 0;
  for (const auto& t : mesh.triangles) {
    if (!counts(t)) continue;
    due += area(t) * wanted / total;
    if (due < 1 || points.size() >= static_cast<std::size_t>(wanted)) continue;
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

constexpr double kHalfFace = 80;  // mm around the tip of the nose: forehead to chin, cheek to cheek, no neck

constexpr double kWorthOfProtrusion = 0.06;  // mm of mirror cost a mm of protrusion makes good

// Points within half a face of `centre`, still in the frame of `points`.
Points around(const Points& points, const Vector3d& centre, Arena& scratch) {
  Points near(&scratch);
  near.reserve(points.size());
  for (const SurfacePoint& p : points)
    if ((p.at_mm - centre).squaredNorm() < kHalfFace * kHalfFace) near.push_back(p);
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

// Foremost point of a paraboloid through the surface around the foremost place near the origin.
Vector3d tip_near(std::span<const SurfacePoint> points) {
  Vector3d top(0, 0, -1e9);
  for (const SurfacePoint& p : points)
    if (std::abs(p.at_mm.x()) < 10 && std::abs(p.at_mm.y()) < 14 && p.at_mm.z() > top.z()) top = p.at_mm;
  if (top.z() < -1e8) return Vector3d::Zero();
  for (int turn = 0; turn < 4; ++turn) {
    Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Identity() * 1e-6;
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
    for (const SurfacePoint& p : points) {
      const double x = p.at_mm.x() - top.x();
      const double y = p.at_mm.y() - top.y();
      if (x * x + y * y > 64 || std::abs(p.at_mm.z() - top.z()) > 12) continue;
      Eigen::Matrix<double, 6, 1> row;
      row << 1, x, y, x * x, x * y, y * y;
      a += row * row.transpose();
      b += row * (p.at_mm.z() - top.z());
    }
    const Eigen::Matrix<double, 6, 1> c = a.ldlt().solve(b);
    const double det = 4 * c[3] * c[5] - c[4] * c[4];
    if (!(c[3] < 0 && det > 1e-8)) break;
    const double x = (-2 * c[5] * c[1] + c[4] * c[2]) / det;
    const double y = (-2 * c[3] * c[2] + c[4] * c[1]) / det;
    if (x * x + y * y > 36) break;
    top += Vector3d(x, y, c[0] + 0.5 * (c[1] * x + c[2] * y));
    if (x * x + y * y < 1e-4) break;
  }
  return top;
}

// How much the surface beside the nose leans back with height: z = a + nod y + c x^2. The x^2 takes
// the roundness of the face, so that a side seen less does not tilt the result.
double nod_of(std::span<const SurfacePoint> points, double radius_mm) {
  Matrix3d a = Matrix3d::Identity() * 1e-6;
  Vector3d b = Vector3d::Zero();
  for (const SurfacePoint& p : points) {
    const double x = p.at_mm.x();
    const double y = p.at_mm.y();
    if (std::abs(x) < 18 || std::abs(x) > 50 || x * x + y * y > radius_mm * radius_mm || p.at_mm.z() < -70) continue;
    const Vector3d row(1, y, x * x / 50);
    a += row * row.transpose();
    b += row * p.at_mm.z();
  }
  return a.ldlt().solve(b)[1];
}

double percentile(std::pmr::vector<double>& values, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
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

// The place that stands out most of those on the plane of symmetry: a chin lies on it too, but stands
// out a third as far as a nose; a shoulder or an ear lies beside it.
Vector3d nose_on_plane(const NoseCandidates& noses, const Frame& upright) {
  constexpr double kBeside = 15;  // mm; a candidate is a sample point, not yet a tip
  Vector3d best = Vector3d::Zero();
  double protrusion = 0;
  for (std::size_t i = 0; i < noses.count; ++i) {
    const Vector3d at = upright.rows * (noses.best[i].at_mm - upright.origin);
    if (std::abs(at.x()) > kBeside || noses.best[i].protrusion_mm <= protrusion) continue;
    protrusion = noses.best[i].protrusion_mm;
    best = at;
  }
  return {0, best.y(), best.z()};
}

// The frame of the most mirror-like face around one of the places that stand out like a nose: x is
// final, the origin is near the tip, the nod is a guess.
Result<Frame> upright_frame(const Points& points, const Vector3d& across, SymmetryPlane& best, StageContext& context) {
  Error why{Errc::PoorGeometry, "nothing on the surface stands out like a nose: look straight into the cameras"};
  double best_score = 1e9;
  Frame frame;
  const NoseCandidates noses = find_nose_candidates(points);
  for (std::size_t i = 0; i < noses.count; ++i) {
    Points face = around(points, noses.best[i].at_mm, context.scratch);
    const Frame guess = first_guess(face, noses.best[i].at_mm, across);
    move_into(face, guess);
    const Result<SymmetryPlane> plane = find_symmetry_plane(face, context);
    if (!plane) {
      if (plane.error().code == Errc::Cancelled) return plane.error();
      why = plane.error();
      continue;
    }
    // A nose stands out three times as far as anything else on a head that is mirror-like.
    const double score = plane->cost_mm - kWorthOfProtrusion * std::min(noses.best[i].protrusion_mm, 25.0);
    if (score >= best_score) continue;
    best_score = score;
    best = *plane;
    Frame upright;
    upright.rows.row(0) = plane->normal;
    upright.rows.row(1) = Vector3d::UnitZ().cross(plane->normal).normalized();
    upright.rows.row(2) = plane->normal.cross(upright.rows.row(1).transpose());
    upright.origin = plane->offset_mm * plane->normal;
    frame = chained(guess, upright);
  }
  if (best_score > 1e8) return why;
  Frame at_nose;
  at_nose.origin = nose_on_plane(noses, frame);
  return chained(frame, at_nose);
}

}  // namespace

Result<void> HeadFrameOptions::check() const {
  if (sample_points < 500 || sample_points > 100'000)
    return Error{Errc::InvalidInput, "sample_points must lie in 500 .. 100000"}.at("head-frame");
  if (!(face_radius_mm >= 40 && face_radius_mm <= 120))
    return Error{Errc::InvalidInput, "face_radius_mm must lie in 40 .. 120"}.at("head-frame");
  return {};
}

Result<HeadFrame> find_head_frame(const FaceMesh& mesh, const HeadFrameOptions& options, StageContext& context,
                                  const Vec3d& across) {
  RELIEVO_TRY(options.check());
  if (context.stop()) return Error{Errc::Cancelled, "the search for the head's frame was stopped"};
  Points points = sample(mesh, options.sample_points, context.scratch);
  if (points.size() < 400)
    return Error{Errc::PoorGeometry, "too little measured surface to tell how the head is turned"};

  SymmetryPlane plane;
  RELIEVO_TRY_ASSIGN(Frame frame, upright_frame(points, {across.x, across.y, across.z}, plane, context));
  move_into(points, frame);

  for (int turn = 0; turn < 6; ++turn) {
    Frame step;
    step.origin = tip_near(points);
    step.origin.x() = 0;  // the plane of symmetry is surer than a crooked tip; moved there at the end
    frame = chained(frame, step);
    move_into(points, step);
    const double nod = std::atan(nod_of(points, options.face_radius_mm));
    Frame turned;
    turned.rows = Eigen::AngleAxisd(nod, Vector3d::UnitX()).toRotationMatrix().transpose();
    frame = chained(frame, turned);
    move_into(points, turned);
    if (std::abs(nod) < 1e-4) break;
  }
  Frame tip;
  tip.origin = tip_near(points);
  frame = chained(frame, tip);
  move_into(points, tip);

  HeadFrame head;
  head.head_from_camera = to_transform(frame);
  head.width_mm = extent(points, 0, context.scratch);
  head.height_mm = extent(points, 1, context.scratch);
  head.nose_relief_mm = relief_of(points);
  head.asymmetry_mm = plane.residual_mm;
  head.overlap = plane.overlap;
  return head;
}

}  // namespace relievo::pipeline
