// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline::bundle {
namespace {

// Picture from board, both scaled to about one (Hartley 1997).
Eigen::Matrix3d homography(const BoardPattern& pattern, const BoardCorners& corners,
                           const CameraIntrinsics& camera) {
  const double scale_px = std::max(camera.width_px, camera.height_px);
  Eigen::Matrix<double, 9, 9> sum = Eigen::Matrix<double, 9, 9>::Zero();
  for (int i = 0; i < pattern.corners(); ++i) {
    const double x = i % pattern.columns / static_cast<double>(pattern.columns);
    const double y = i / pattern.columns / static_cast<double>(pattern.columns);
    const Vec2d& at = corners[static_cast<std::size_t>(i)];
    if (!seen(at)) continue;
    const double u = (at.x - 0.5 * camera.width_px) / scale_px;
    const double v = (at.y - 0.5 * camera.height_px) / scale_px;
    Eigen::Matrix<double, 2, 9> rows;
    rows << x, y, 1, 0, 0, 0, -u * x, -u * y, -u, 0, 0, 0, x, y, 1, -v * x, -v * y, -v;
    sum += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(sum);
  const Eigen::Matrix<double, 9, 1> h = eigen.eigenvectors().col(0);
  Eigen::Matrix3d m;
  m << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  return m;
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

}  // namespace

bool first_guess(Problem& problem) {
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
  return !views.empty();
}

}  // namespace relievo::pipeline::bundle
