// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/bundle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "pipeline/base/solving.h"

namespace relievo::pipeline::bundle {
namespace {

// Picture from board, both scaled to about one (Hartley 1997).
Eigen::Matrix3d homography(const BoardPattern& pattern, const BoardCorners& corners,
                           const CameraIntrinsics& camera) {
  const double scale_px = std::max(camera.width_px, camera.height_px);
  Eigen::Matrix<double, 9, 9> sum = Eigen::Matrix<double, 9, 9>::Zero();
  for (int i = 0; i < pattern.corners(); ++i) {
    const double x = i % pattern.columns / double(pattern.columns);
    const double y = i / pattern.columns / double(pattern.columns);
    const Vec2d& at = corners[std::size_t(i)];
    if (!seen(at)) continue;
    const double u = (at.x - 0.5 * camera.width_px) / scale_px;
    const double v = (at.y - 0.5 * camera.height_px) / scale_px;
    Eigen::Matrix<double, 2, 9> rows;
    rows << x, y, 1, 0, 0, 0, -u * x, -u * y, -u, 0, 0, 0, x, y, 1, -v * x, -v * y, -v;
    sum += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(sum);
  const Eigen::Matrix<double, 9, 1> h = eigen.eigenvectors().col(0);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(h.data());
}

// Focal length (square pixels) in units of the longer side: each view gives two equations in 1/f².
double focal_of(const std::vector<Eigen::Matrix3d>& views) {
  double up = 0;
  double down = 0;
  for (Eigen::Matrix3d h : views) {
    h /= std::sqrt(h.col(0).norm() * h.col(1).norm());
    const auto a = h.col(0);
    const auto b = h.col(1);
    const double rows[2][2] = {
        {a.x() * b.x() + a.y() * b.y(), a.z() * b.z()},
        {a.x() * a.x() + a.y() * a.y() - b.x() * b.x() - b.y() * b.y(), a.z() * a.z() - b.z() * b.z()}};
    for (const auto& row : rows) {
      up -= row[0] * row[1];
      down += row[0] * row[0];
    }
  }
  return up > 0 && down > 0 ? std::sqrt(down / up) : 0;
}

Pose pose_of(const Eigen::Matrix3d& h, double focal, double board_mm) {
  Eigen::Matrix3d m = h;
  m.topRows<2>() /= focal;
  m /= std::sqrt(m.col(0).norm() * m.col(1).norm());
  if (m(2, 2) < 0) m = -m;
  Eigen::Matrix3d r;
  r << m.col(0), m.col(1), m.col(0).cross(m.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU() * svd.matrixV().transpose(), m.col(2) * board_mm};
}

constexpr double kBehind = 1e12;  // the price of a board behind the camera, px²

struct ViewTerms {
  Eigen::Matrix<double, kGlobals, 6> b = Eigen::Matrix<double, kGlobals, 6>::Zero();
  Matrix6d c = Matrix6d::Zero();
  Vector6d h = Vector6d::Zero();
};

struct Normal {
  Globals a = Globals::Zero();
  GlobalVector g = GlobalVector::Zero();
  std::vector<ViewTerms> views;
  double cost = 0;     // with the priors
  double squared = 0;  // without
};

template <int kEye>
void add_camera(const Problem& p, View& view, Normal& n, ViewTerms& of_view) {
  using Terms = CornerTerms<kEye>;
  if (view.seen[kEye] == nullptr) return;
  auto own_a = n.a.template block<Terms::kOwn, Terms::kOwn>(Terms::kBase, Terms::kBase);
  auto own_g = n.g.template segment<Terms::kOwn>(Terms::kBase);
  auto own_b = of_view.b.template middleRows<Terms::kOwn>(Terms::kBase);
  for (int i = 0; i < p.pattern.corners(); ++i) {
    if (!seen((*view.seen[kEye])[std::size_t(i)])) continue;
    ++view.corners[kEye];
    const Terms t(p, view, i);
    view.squared_px[kEye] += t.depth_mm > 0 ? t.residual.squaredNorm() : kBehind;
    own_a.noalias() += t.by_own.transpose() * t.by_own;
    own_g.noalias() += t.by_own.transpose() * t.residual;
    own_b.noalias() += t.by_own.transpose() * t.by_pose;
    of_view.c.noalias() += t.by_pose.transpose() * t.by_pose;
    of_view.h.noalias() += t.by_pose.transpose() * t.residual;
  }
}

double& parameter(Problem& p, int i) {
  CameraIntrinsics& c = p.camera[std::size_t(i / kCameraGlobals)];
  switch (i % kCameraGlobals) {
    case 0: return c.focal_px.x;
    case 1: return c.focal_px.y;
    case 2: return c.centre_px.x;
    case 3: return c.centre_px.y;
    default: return c.distortion[i % kCameraGlobals - 4];
  }
}

void add_priors(Problem& p, Normal& n) {
  for (int i = 0; i < 2 * kCameraGlobals; ++i) {
    const Prior& prior = p.prior[std::size_t(i)];
    const double weight = p.noise_px2 * prior.weight;
    const double off = prior.mean - parameter(p, i);
    n.a(i, i) += weight;
    n.g(i) += weight * off;
    n.cost += weight * off * off;
  }
  for (int eye = 0; eye < 2; ++eye) {
    const int at = eye * kCameraGlobals;
    const CameraBelief& belief = p.belief[std::size_t(eye)];
    const CameraVector away = belief.mean - parameters_of(p.camera[std::size_t(eye)]);
    n.a.block<kCameraGlobals, kCameraGlobals>(at, at) += belief.information;
    n.g.segment<kCameraGlobals>(at) += belief.information * away;
    n.cost += away.dot(belief.information * away);
    const double fy = parameter(p, at + 1);
    if (!(p.aspect_weight[std::size_t(eye)] > 0) || !(std::abs(fy) > 1)) continue;
    const double weight = p.noise_px2 * p.aspect_weight[std::size_t(eye)] / (fy * fy);
    const double off = parameter(p, at) - fy;
    n.a.block<2, 2>(at, at) += weight * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    n.g.segment<2>(at) += weight * off * Eigen::Vector2d(-1, 1);
    n.cost += weight * off * off;
  }
}

Normal linearise(Problem& p) {
  Normal n;
  n.views.resize(p.views.size());
  p.residuals = 0;
  for (std::size_t v = 0; v < p.views.size(); ++v) {
    View& view = p.views[v];
    view.squared_px = {};
    view.corners = {};
    add_camera<0>(p, view, n, n.views[v]);
    add_camera<1>(p, view, n, n.views[v]);
    n.squared += view.squared_px[0] + view.squared_px[1];
    p.residuals += 2 * (view.corners[0] + view.corners[1]);
    view.information = n.views[v].c;
  }
  n.cost = n.squared;
  add_priors(p, n);
  // What is not free neither pulls nor moves.
  for (int i = 0; i < kGlobals; ++i) {
    if (p.free[std::size_t(i)]) continue;
    n.a.row(i).setZero();
    n.a.col(i).setZero();
    n.a(i, i) = 1;
    n.g(i) = 0;
    for (ViewTerms& of_view : n.views) of_view.b.row(i).setZero();
  }
  return n;
}

// One damped step; the Schur complement without damping is kept for the covariance.
Problem stepped(const Problem& p, const Normal& n, double damping) {
  Globals s = n.a;
  s.diagonal() *= 1 + damping;
  GlobalVector g = n.g;
  std::vector<Matrix6d> inverse;
  for (const ViewTerms& of_view : n.views) {
    Matrix6d c = of_view.c;
    c.diagonal() *= 1 + damping;
    const Matrix6d& back = inverse.emplace_back(inverted<6>(c));
    s.noalias() -= of_view.b * back * of_view.b.transpose();
    g.noalias() -= of_view.b * (back * of_view.h);
  }
  const GlobalVector by = solved<kGlobals>(s, g);
  Problem moved = p;
  step_globals(moved, by);
  for (std::size_t v = 0; v < inverse.size(); ++v)
    moved.views[v].left_from_board.step(inverse[v] * (n.views[v].h - n.views[v].b.transpose() * by));
  return moved;
}

// Of one view alone, without what is known beforehand.
Normal linearise_alone(const Problem& rig, const View& view) {
  Problem one = rig;
  one.views.assign(1, view);
  one.prior = {};
  one.aspect_weight = {};
  one.belief = {};
  return linearise(one);
}

}  // namespace

void first_guess(Problem& problem) {
  CameraIntrinsics& camera = problem.camera[0];
  std::vector<Eigen::Matrix3d> views;
  for (const View& view : problem.views) views.push_back(homography(problem.pattern, *view.seen[0], camera));
  double focal = focal_of(views);
  // Boards that all face the camera leave the focal length open; a usual lens then is the start.
  if (!(focal > 0.3 && focal < 30)) focal = 1.5;
  const double side = std::max(camera.width_px, camera.height_px);
  camera.focal_px = {focal * side, focal * side};
  camera.centre_px = {0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1)};
  for (double& k : camera.distortion) k = 0;
  const double board_mm = problem.pattern.columns * problem.pattern.square_mm;
  for (std::size_t v = 0; v < views.size(); ++v)
    problem.views[v].left_from_board = pose_of(views[v], focal, board_mm);
}

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity() + cross(turn);
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Eigen::Vector3d turn_of(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

RigidTransform transform_of(const Pose& pose) {
  RigidTransform t;
  for (int i = 0; i < 9; ++i) t.rotation.m[i] = pose.rotation(i / 3, i % 3);
  t.translation_mm = {pose.translation_mm.x(), pose.translation_mm.y(), pose.translation_mm.z()};
  return t;
}

Pose pose_of(const RigidTransform& t) {
  Pose pose;
  for (int i = 0; i < 9; ++i) pose.rotation(i / 3, i % 3) = t.rotation.m[i];
  pose.translation_mm = {t.translation_mm.x, t.translation_mm.y, t.translation_mm.z};
  return pose;
}

void Pose::step(const Vector6d& by) {
  rotation = Eigen::Quaterniond(rotation_of(by.head<3>()) * rotation).normalized().toRotationMatrix();
  translation_mm += by.tail<3>();
}

Vec2d project(const CameraIntrinsics& camera, const Eigen::Vector3d& point) {
  return pixel_of_ray(camera, {point.x() / point.z(), point.y() / point.z()});
}

bool solve(Problem& problem) {
  constexpr int kMaxSteps = 200;
  constexpr double kSmallGain = 1e-11;
  constexpr double kFirm = 1e-5;
  double damping = 1e-4;
  Normal normal = linearise(problem);
  for (int i = 0; i < kMaxSteps && damping < 1e10; ++i) {
    Problem next = stepped(problem, normal, damping);
    Normal there = linearise(next);
    if (!std::isfinite(there.cost) || there.cost > normal.cost) {
      if (damping < kFirm && there.cost <= (1 + kSmallGain) * normal.cost) break;
      damping *= 10;
      continue;
    }
    const double gain = normal.cost - there.cost;
    problem = std::move(next);
    normal = std::move(there);
    damping = std::max(damping / 10, 1e-12);
    // A small gain of a strongly damped step says nothing: the valley may be long and curved.
    if (gain <= kSmallGain * normal.cost && damping < kFirm) break;
  }
  problem.squared_px = normal.squared;
  problem.information = normal.a;
  for (const ViewTerms& of_view : normal.views)
    problem.information -= eliminated<6, kGlobals>(of_view.c, of_view.b);
  problem.covariance = inverted<kGlobals>(problem.information);
  for (int i = 0; i < kGlobals; ++i)
    if (!problem.free[std::size_t(i)]) problem.covariance(i, i) = 0;
  return std::isfinite(normal.cost) && problem.covariance.allFinite();
}

CameraVector parameters_of(const CameraIntrinsics& c) {
  CameraVector p;
  p << c.focal_px.x, c.focal_px.y, c.centre_px.x, c.centre_px.y, c.distortion[0], c.distortion[1],
      c.distortion[2], c.distortion[3], c.distortion[4];
  return p;
}

void step_globals(Problem& p, const GlobalVector& by) {
  for (int i = 0; i < 2 * kCameraGlobals; ++i) parameter(p, i) += by[i];
  p.right_from_left.step(by.tail<6>());
}

std::vector<Problem> without_each_view(Problem whole, std::size_t count) {
  std::vector<Problem> without;
  const std::vector<View> views = std::exchange(whole.views, {});
  for (std::size_t v = 0; v < count; ++v) {
    const Normal n = linearise_alone(whole, views[v]);
    const auto& [b, c, h] = n.views[0];
    Globals information = whole.information - (n.a - eliminated<6, kGlobals>(c, b));
    GlobalVector pull = b * solved<6>(c, h) - n.g;
    for (int i = 0; i < kGlobals; ++i)
      if (!whole.free[std::size_t(i)]) information(i, i) = 1;
    without.push_back(whole);
    step_globals(without.back(), solved<kGlobals>(information, pull));
  }
  return without;
}

Globals information_of(const Problem& rig, const View& view) {
  const Normal n = linearise_alone(rig, view);
  return n.a - eliminated<6, kGlobals>(n.views[0].c, n.views[0].b);
}

bool solve_poses(Problem& problem) {
  const auto free = problem.free;
  problem.free.fill(false);
  const bool solved = solve(problem);
  problem.free = free;
  return solved;
}

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Vector2d pixel_of(const CameraIntrinsics& c, const Eigen::Vector3d& p, CameraJacobian& by_camera,
                         PointJacobian& by_point) {
  const double x = p.x() / p.z();
  const double y = p.y() / p.z();
  const double* k = c.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double xd = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
  const double yd = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  const double fx = c.focal_px.x;
  const double fy = c.focal_px.y;
  const double r4 = r2 * r2;
  by_camera << xd, 0, 1, 0, fx * x * r2, fx * x * r4, fx * 2 * x * y, fx * (r2 + 2 * x * x), fx * x * r4 * r2,
      0, yd, 0, 1, fy * y * r2, fy * y * r4, fy * (r2 + 2 * y * y), fy * 2 * x * y, fy * y * r4 * r2;
  const double slope = 2 * (k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]));  // of radial, by x over x
  Eigen::Matrix2d by_plane;
  by_plane << radial + slope * x * x + 2 * k[2] * y + 6 * k[3] * x,
      slope * x * y + 2 * k[2] * x + 2 * k[3] * y, slope * x * y + 2 * k[2] * x + 2 * k[3] * y,
      radial + slope * y * y + 6 * k[2] * y + 2 * k[3] * x;
  PointJacobian plane_by_point;
  plane_by_point << 1 / p.z(), 0, -x / p.z(), 0, 1 / p.z(), -y / p.z();
  by_point = Eigen::Vector2d(fx, fy).asDiagonal() * by_plane * plane_by_point;
  return {fx * xd + c.centre_px.x, fy * yd + c.centre_px.y};
}

}  // namespace relievo::pipeline::bundle
