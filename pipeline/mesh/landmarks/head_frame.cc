// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/mesh/landmarks/head_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "pipeline/mesh/landmarks/face_relief.h"
#include "pipeline/mesh/landmarks/nose_tip.h"
#include "pipeline/mesh/landmarks/symmetry_plane.h"

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

constexpr double kWorthOfProtrusion = 0.2;  // mm of mirror cost a mm of protrusion makes good: half a nose is a poor mirror, and still a nose
constexpr double kCostOfOneSide = 2;        // mm: a chin may stand out further than a nose, seen from the neck
constexpr double kMostOfANose = 16;         // mm: what stands out further is no better nose, but hair

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

// How one-sided the surface around the origin is, 0 as around a nose to 1: a chin has a face above it and next to
// nothing below, a forehead the other way round. y is up to some tens of degrees.
double one_sidedness(std::span<const SurfacePoint> points) {
  constexpr double kBeside = 15;    // mm: the place itself is on neither side
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
    const double one_sided = one_sidedness(face);
    const Result<SymmetryPlane> plane = find_symmetry_plane(face, context);
    if (!plane) {
      if (plane.error().code == Errc::Cancelled) return plane.error();
      why = plane.error();
      continue;
    }
    // A nose stands out three times as far as anything else on a head that is mirror-like.
    const double score = plane->cost_mm - kWorthOfProtrusion * std::min(noses.best[i].protrusion_mm, kMostOfANose) + kCostOfOneSide * one_sided;
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

// The core of a face: what cameras see of it however it turns. Beside the nose and below the eyes; the tip.
constexpr double kCoreHalf = 50, kCoreFrom = -30, kCoreTo = 78;
constexpr double kCoreCell = 1.25;
constexpr double kTipReach = 11;    // mm around the tip: both wings' flanks belong to it
constexpr double kRidgeShare = 0.2; // of the vote of the nose's sides: highlights lie on the ridge
constexpr double kTipScale = 1.0;   // mm: what lies further off the paraboloid counts little

struct Core {
  double nod_rad = 0;              // how much the cheeks lean back with height
  Vector3d tip = Vector3d::Zero(); // on the plane of symmetry
};

// A window beside or above the nose: its height and lean at its middle, by a quadratic through what was
// seen of it, so that a part that is missing shifts nothing.
struct Window { double from_x, to_x, from_y, to_y; };
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
      const double x = core.x_mm(c), y = core.y_mm(r), z = static_cast<double>(core.z(c, r));
      if (std::isnan(z) || x < w.from_x || x > w.to_x || y < w.from_y || y > w.to_y || z < -70) continue;
      Vector5d row;
      const double u = (x - middle_x) / 20, v = (y - middle_y) / 20;
      row << 1, u, v, u * u, v * v;
      a += row * row.transpose();
      b += row * z;
      ++count;
    }
  z_mm = a.ldlt().solve(b)[0];
  return count > 200;
}

double nod_of(const FaceRelief& core) {
  double cheek = 0, brow = 0;
  if (!height_at_middle(core, kCheek, cheek) || !height_at_middle(core, kBrow, brow)) return 0;
  return std::atan2(brow - cheek, 0.5 * (kBrow.from_y + kBrow.to_y - kCheek.from_y - kCheek.to_y)) - kBrowBeforeCheeks;
}

// Foremost point of a paraboloid, upright in x, through the surface around the foremost place near the
// origin. Robust (Geman-McClure): a highlight or the nose's limb may have pulled a part of it away.
Vector3d tip_of(const FaceRelief& core) {
  Vector3d top(0, 0, -1e9);
  for (int r = 0; r < core.rows(); ++r)
    for (int c = 0; c < core.columns(); ++c)
      if (std::abs(core.x_mm(c)) < 4 && std::abs(core.y_mm(r)) < 16 && static_cast<double>(core.z(c, r)) > top.z()) top = {0, core.y_mm(r), static_cast<double>(core.z(c, r))};
  if (top.z() < -1e8) return Vector3d::Zero();
  Eigen::Vector4d k = Eigen::Vector4d::Zero();
  for (int turn = 0; turn < 12; ++turn) {
    Eigen::Matrix4d a = Eigen::Matrix4d::Identity() * 1e-6;
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (int r = 0; r < core.rows(); ++r)
      for (int c = 0; c < core.columns(); ++c) {
        const double x = core.x_mm(c), y = core.y_mm(r) - top.y(), z = static_cast<double>(core.z(c, r)) - top.z();
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

Core core_of(const FaceMesh& mesh, const Frame& frame, Arena& scratch) {
  const Arena::Mark mark(scratch);
  FaceRelief core({-kCoreHalf, kCoreHalf, kCoreFrom - 5, kCoreTo + 5, kCoreCell}, &scratch);
  core.add(mesh, to_transform(frame));
  const Vector3d tip = tip_of(core);
  core.symmetrise();
  return {nod_of(core), tip};
}

Result<void> set_upright(const FaceMesh& mesh, Frame& frame, Points& points, StageContext& context) {
  constexpr double kFurthest = 25;  // mm from the candidate: further on lies the chin, where this would walk along a nose that is missing
  const Vector3d start = frame.origin;
  for (int round = 0; round < 8; ++round) {
    if (context.stop()) return Error{Errc::Cancelled, "the search for the head's frame was stopped"};
    const Core core = core_of(mesh, frame, context.scratch);
    Frame tip;
    tip.origin = core.tip;
    if ((chained(frame, tip).origin - start).norm() < kFurthest) move(frame, points, tip);
    turn(frame, points, core.nod_rad);
    if (core.tip.norm() < 1e-2 && std::abs(core.nod_rad) < 1e-4) break;
  }
  return {};
}

}  // namespace

Result<void> HeadFrameOptions::check() const {
  if (sample_points < 500 || sample_points > 100'000)
    return Error{Errc::InvalidInput, "sample_points must lie in 500 .. 100000"}.at("head-frame");
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

  RELIEVO_TRY(set_upright(mesh, frame, points, context));

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
