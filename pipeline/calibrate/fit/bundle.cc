// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/bundle.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace relievo::pipeline::bundle {
namespace {

using Jacobian = Eigen::Matrix<double, 2, 9>;  // of a pixel by fx fy cx cy k1 k2 p1 p2 k3
constexpr double kBehind = 1e12;  // the price of a board behind the camera, px²

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Pixel of a point in the camera's frame, with its derivatives where asked for.
Eigen::Vector2d pixel_of(const CameraIntrinsics& c, const Eigen::Vector3d& p, Jacobian* by_camera,
                         Eigen::Matrix<double, 2, 3>* by_point) {
  const double x = p.x() / p.z();
  const double y = p.y() / p.z();
  const double* k = c.distortion;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double xd = x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x);
  const double yd = y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y;
  const double fx = c.focal_px.x;
  const double fy = c.focal_px.y;
  if (by_camera != nullptr) {
    const double r4 = r2 * r2;
    *by_camera << xd, 0, 1, 0, fx * x * r2, fx * x * r4, fx * 2 * x * y, fx * (r2 + 2 * x * x),
        fx * x * r4 * r2, 0, yd, 0, 1, fy * y * r2, fy * y * r4, fy * (r2 + 2 * y * y), fy * 2 * x * y,
        fy * y * r4 * r2;
  }
  if (by_point != nullptr) {
    const double slope = 2 * (k[0] + r2 * (2 * k[1] + r2 * 3 * k[4]));  // of radial, by x over x
    Eigen::Matrix2d by_plane;
    by_plane << radial + slope * x * x + 2 * k[2] * y + 6 * k[3] * x,
        slope * x * y + 2 * k[2] * x + 2 * k[3] * y, slope * x * y + 2 * k[2] * x + 2 * k[3] * y,
        radial + slope * y * y + 6 * k[2] * y + 2 * k[3] * x;
    Eigen::Matrix<double, 2, 3> plane_by_point;
    plane_by_point << 1 / p.z(), 0, -x / p.z(), 0, 1 / p.z(), -y / p.z();
    *by_point = Eigen::Vector2d(fx, fy).asDiagonal() * by_plane * plane_by_point;
  }
  return {fx * xd + c.centre_px.x, fy * yd + c.centre_px.y};
}

struct Normal {
  Globals a = Globals::Zero();
  GlobalVector g = GlobalVector::Zero();
  std::vector<Eigen::Matrix<double, kGlobals, 6>> b;
  std::vector<Matrix6d> c;
  std::vector<Vector6d> h;
  double cost = 0;     // with the priors
  double squared = 0;  // without
};

struct Block {
  Globals& a;
  GlobalVector& g;
  Eigen::Matrix<double, kGlobals, 6>& b;
  Matrix6d& c;
  Vector6d& h;
};

// The globals of one eye lie together: its camera, and for the right eye the relation behind it.
template <int kEye>
void add_camera(const Problem& p, View& view, Block block) {
  constexpr int kBase = kEye == 0 ? 0 : 9;
  constexpr int kOwn = kEye == 0 ? 9 : 15;
  const Pose& relation = p.right_from_left;
  auto own_a = block.a.template block<kOwn, kOwn>(kBase, kBase);
  auto own_g = block.g.template segment<kOwn>(kBase);
  auto own_b = block.b.template middleRows<kOwn>(kBase);
  for (int i = 0; i < p.pattern.corners(); ++i) {
    const Vec2d& at = (*view.seen[kEye])[static_cast<std::size_t>(i)];
    if (!seen(at)) continue;
    ++view.corners[kEye];
    const Eigen::Vector3d board((i % p.pattern.columns) * p.pattern.square_mm,
                                (i / p.pattern.columns) * p.pattern.square_mm, 0);
    const Eigen::Vector3d turned = view.left_from_board.rotation * board;
    Eigen::Vector3d here = turned + view.left_from_board.translation_mm;
    const Eigen::Vector3d turned_left = relation.rotation * here;
    if constexpr (kEye == 1) here = turned_left + relation.translation_mm;
    Jacobian by_camera;
    Eigen::Matrix<double, 2, 3> by_point;
    const Eigen::Vector2d pixel = pixel_of(p.camera[kEye], here, &by_camera, &by_point);
    const Eigen::Vector2d residual(at.x - pixel.x(), at.y - pixel.y());
    view.squared_px[kEye] += here.z() > 0 ? residual.squaredNorm() : kBehind;
    Eigen::Matrix<double, 2, kOwn> by_own;
    by_own.template leftCols<9>() = by_camera;
    Eigen::Matrix<double, 2, 3> by_left = by_point;
    if constexpr (kEye == 1) {
      by_own.template rightCols<6>() << by_point * -cross(turned_left), by_point;
      by_left = by_point * relation.rotation;
    }
    Eigen::Matrix<double, 2, 6> by_pose;
    by_pose << by_left * -cross(turned), by_left;
    own_a.noalias() += by_own.transpose() * by_own;
    own_g.noalias() += by_own.transpose() * residual;
    own_b.noalias() += by_own.transpose() * by_pose;
    block.c.noalias() += by_pose.transpose() * by_pose;
    block.h.noalias() += by_pose.transpose() * residual;
  }
}

double& parameter(Problem& p, int i) {
  CameraIntrinsics& c = p.camera[static_cast<std::size_t>(i / kCameraGlobals)];
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
    const Prior& prior = p.prior[static_cast<std::size_t>(i)];
    const double weight = p.noise_px2 * prior.weight;
    const double off = prior.mean - parameter(p, i);
    n.a(i, i) += weight;
    n.g(i) += weight * off;
    n.cost += weight * off * off;
  }
  for (int eye = 0; eye < 2; ++eye) {
    const int at = eye * kCameraGlobals;
    const double fy = parameter(p, at + 1);
    if (!(p.aspect_weight[static_cast<std::size_t>(eye)] > 0) || !(std::abs(fy) > 1)) continue;
    const double weight = p.noise_px2 * p.aspect_weight[static_cast<std::size_t>(eye)] / (fy * fy);
    const double off = parameter(p, at) - fy;
    n.a.block<2, 2>(at, at) += weight * (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
    n.g.segment<2>(at) += weight * off * Eigen::Vector2d(-1, 1);
    n.cost += weight * off * off;
  }
}

Normal linearise(Problem& p) {
  Normal n;
  n.b.assign(p.views.size(), Eigen::Matrix<double, kGlobals, 6>::Zero());
  n.c.assign(p.views.size(), Matrix6d::Zero());
  n.h.assign(p.views.size(), Vector6d::Zero());
  p.residuals = 0;
  for (std::size_t v = 0; v < p.views.size(); ++v) {
    View& view = p.views[v];
    view.squared_px = {};
    view.corners = {};
    const Block block{n.a, n.g, n.b[v], n.c[v], n.h[v]};
    if (view.seen[0] != nullptr) add_camera<0>(p, view, block);
    if (view.seen[1] != nullptr) add_camera<1>(p, view, block);
    n.squared += view.squared_px[0] + view.squared_px[1];
    p.residuals += 2 * (view.corners[0] + view.corners[1]);
    view.information = n.c[v];
  }
  n.cost = n.squared;
  add_priors(p, n);
  // What is not free neither pulls nor moves.
  for (int i = 0; i < kGlobals; ++i) {
    if (p.free[static_cast<std::size_t>(i)]) continue;
    n.a.row(i).setZero();
    n.a.col(i).setZero();
    n.a(i, i) = 1;
    n.g(i) = 0;
    for (auto& b : n.b) b.row(i).setZero();
  }
  return n;
}


// One damped step; the Schur complement without damping is kept for the covariance.
Problem stepped(const Problem& p, const Normal& n, double damping) {
  Globals s = n.a;
  s.diagonal() *= 1 + damping;
  GlobalVector g = n.g;
  std::vector<Matrix6d> inverse(n.c.size());
  for (std::size_t v = 0; v < n.c.size(); ++v) {
    Matrix6d c = n.c[v];
    c.diagonal() *= 1 + damping;
    inverse[v] = c.ldlt().solve(Matrix6d::Identity());
    s.noalias() -= n.b[v] * inverse[v] * n.b[v].transpose();
    g.noalias() -= n.b[v] * (inverse[v] * n.h[v]);
  }
  const GlobalVector by = s.ldlt().solve(g);
  Problem moved = p;
  step_globals(moved, by);
  for (std::size_t v = 0; v < n.c.size(); ++v)
    moved.views[v].left_from_board.step(inverse[v] * (n.h[v] - n.b[v].transpose() * by));
  return moved;
}

void keep_covariance(Problem& p, const Normal& n) {
  p.information = n.a;
  for (std::size_t v = 0; v < n.c.size(); ++v)
    p.information.noalias() -= n.b[v] * n.c[v].ldlt().solve(n.b[v].transpose());
  p.covariance = p.information.ldlt().solve(Globals::Identity());
  for (int i = 0; i < kGlobals; ++i)
    if (!p.free[static_cast<std::size_t>(i)]) p.covariance(i, i) = 0;
}

}  // namespace

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity() + cross(turn);
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Eigen::Vector3d turn_of(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

void Pose::step(const Vector6d& by) {
  rotation = Eigen::Quaterniond(rotation_of(by.head<3>()) * rotation).normalized().toRotationMatrix();
  translation_mm += by.tail<3>();
}

Vec2d project(const CameraIntrinsics& camera, const Pose& camera_from_board, double x_mm, double y_mm) {
  const Eigen::Vector2d pixel = pixel_of(
      camera, camera_from_board.rotation * Eigen::Vector3d(x_mm, y_mm, 0) + camera_from_board.translation_mm,
      nullptr, nullptr);
  return {pixel.x(), pixel.y()};
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
  keep_covariance(problem, normal);
  return std::isfinite(normal.cost) && problem.covariance.allFinite();
}

void step_globals(Problem& p, const GlobalVector& by) {
  for (int i = 0; i < 2 * kCameraGlobals; ++i) parameter(p, i) += by[i];
  p.right_from_left.step(by.tail<6>());
}

std::vector<Problem> without_each_view(const Problem& solved) {
  std::vector<Problem> without;
  Problem one = solved;
  for (const View& view : solved.views) {
    one.views.assign(1, view);
    one.prior = {};
    one.aspect_weight = {};
    const Normal n = linearise(one);
    const auto to_pose = n.c[0].ldlt();
    Globals information = solved.information - (n.a - n.b[0] * to_pose.solve(n.b[0].transpose()));
    GlobalVector pull = n.b[0] * to_pose.solve(n.h[0]) - n.g;
    for (int i = 0; i < kGlobals; ++i)
      if (!solved.free[static_cast<std::size_t>(i)]) information(i, i) = 1;
    without.push_back(solved);
    step_globals(without.back(), information.ldlt().solve(pull));
  }
  return without;
}

bool solve_poses(Problem& problem) {
  const auto free = problem.free;
  problem.free.fill(false);
  const bool solved = solve(problem);
  problem.free = free;
  return solved;
}

}  // namespace relievo::pipeline::bundle
