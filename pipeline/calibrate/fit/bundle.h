// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bundle adjustment of one or two cameras that look at a flat board: the parameters under which the
// corners seen are the most likely ones (least squares on pixels; Triggs et al. 2000). The poses of
// the board are eliminated view by view (Schur complement), so the time grows with the views only.
// Inside calibrate/ only. Millimetres, pixels. Thread: any.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "pipeline/calibrate/board/board_finder.h"
#include "pipeline/model/calibration.h"

namespace relievo::pipeline::bundle {

// A rigid motion; a step (w, d) of six numbers turns it into (exp(w) R, t + d).
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();

  void step(const Eigen::Matrix<double, 6, 1>& by);
  // First `other`, then this.
  Pose operator*(const Pose& other) const {
    return {rotation * other.rotation, rotation * other.translation_mm + translation_mm};
  }
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return rotation * point + translation_mm; }
};
RigidTransform transform_of(const Pose& pose);
Pose pose_of(const RigidTransform& transform);

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& turn);  // exp
Eigen::Vector3d turn_of(const Eigen::Matrix3d& rotation);  // log

struct View {
  View(const BoardCorners* left, const BoardCorners* right, const Pose& pose)
      : seen{left, right}, left_from_board(pose) {}

  std::array<const BoardCorners*, 2> seen;  // borrowed; nullptr where a camera has no board
  Pose left_from_board;
  std::array<double, 2> squared_px{};       // out: sum of squared residuals
  std::array<int, 2> corners{};             // out: that took part
  Matrix6d information = Matrix6d::Zero();  // out: of the pose, for corners of 1 px noise
};

// Order of the global parameters: nine of each camera (fx fy cx cy k1 k2 p1 p2 k3), then the step of
// right_from_left.
inline constexpr int kCameraGlobals = 9;
inline constexpr int kGlobals = 24;
using Globals = Eigen::Matrix<double, kGlobals, kGlobals>;
using GlobalVector = Eigen::Matrix<double, kGlobals, 1>;

// What is known of a parameter before the first picture: normal, weight 1/sigma², 0 for nothing. It
// stands in for the choice of how many distortion terms to fit: what the pictures do not determine
// stays near what lenses are like, and its uncertainty is in the covariance.
struct Prior {
  double mean = 0;
  double weight = 0;
};

// What is known of one camera's parameters together: normal, for corners of 1 px noise.
using CameraVector = Eigen::Matrix<double, kCameraGlobals, 1>;
using CameraMatrix = Eigen::Matrix<double, kCameraGlobals, kCameraGlobals>;
struct CameraBelief {
  CameraVector mean = CameraVector::Zero();
  CameraMatrix information = CameraMatrix::Zero();
};

struct Problem {
  BoardPattern pattern;
  std::array<CameraIntrinsics, 2> camera;
  Pose right_from_left;
  std::vector<View> views;
  std::array<bool, kGlobals> free{};  // the others keep their value
  std::array<Prior, kGlobals> prior{};
  std::array<double, 2> aspect_weight{};  // of fx / fy being 1, for each camera: 1/sigma²
  std::array<CameraBelief, 2> belief{};
  double noise_px2 = 0.01;  // variance of one coordinate of a corner: weighs the priors
  // out:
  double squared_px = 0;  // of all views, without the priors
  int residuals = 0;      // numbers, two a corner
  Globals information =
      Globals::Zero();                   // of the globals, poses eliminated, corners of 1 px noise, priors in
  Globals covariance = Globals::Zero();  // its inverse: times noise_px2; 0 for what is not free
};

CameraVector parameters_of(const CameraIntrinsics& camera);

// Places on a board, in its own frame: of a column and row, of a corner by its number, of the middle.
inline Eigen::Vector3d on_board(const BoardPattern& pattern, double column, double row) {
  return {column * pattern.square_mm, row * pattern.square_mm, 0};
}
inline Eigen::Vector3d on_board(const BoardPattern& pattern, int corner) {
  return on_board(pattern, corner % pattern.columns, corner / pattern.columns);
}
inline Eigen::Vector3d middle_of(const BoardPattern& pattern) {
  return on_board(pattern, 0.5 * (pattern.columns - 1), 0.5 * (pattern.rows - 1));
}

// Where a camera sees a point of its own frame.
Vec2d project(const CameraIntrinsics& camera, const Eigen::Vector3d& point);

// False where it does not converge to a finite answer.
bool solve(Problem& problem);

// Poses and sums only: the same problem with nothing global free.
bool solve_poses(Problem& problem);

// For each of the first `count` views where the globals would go if it had never been taken: one Newton step
// from the solution, poses adapting (exact for a linear problem). The copies have no views.
std::vector<Problem> without_each_view(Problem whole, std::size_t count);

// What one more view would add to Problem::information at these globals; `rig` without views.
Globals information_of(const Problem& rig, const View& view);

// Globals stepped by `by`; for carrying the covariance to whatever is computed from them.
void step_globals(Problem& problem, const GlobalVector& by);

// A first guess of focal length and poses from the boards' homographies, principal point in the
// middle (Zhang 2000).
void first_guess(Problem& problem);

Eigen::Matrix3d cross(const Eigen::Vector3d& v);

using CameraJacobian = Eigen::Matrix<double, 2, 9>;  // of a pixel by fx fy cx cy k1 k2 p1 p2 k3
using PointJacobian = Eigen::Matrix<double, 2, 3>;

// Pixel of a point in the camera's frame, with its derivatives.
Eigen::Vector2d pixel_of(const CameraIntrinsics& camera, const Eigen::Vector3d& point,
                         CameraJacobian& by_camera, PointJacobian& by_point);

// One corner in one picture: what the fit misses it by, and how its picture follows every parameter.
// The globals of one eye lie together: its camera, and for the right eye the relation behind it.
template <int kEye>
struct CornerTerms {
  static constexpr int kBase = kEye == 0 ? 0 : kCameraGlobals;
  static constexpr int kOwn = kEye == 0 ? 9 : 15;

  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, kOwn> by_own;
  Eigen::Matrix<double, 2, 6> by_pose;
  PointJacobian by_left;  // by the point in the left camera's frame
  double depth_mm = 0;

  CornerTerms(const Problem& p, const View& view, int corner) {
    const Vec2d& at = (*view.seen[kEye])[std::size_t(corner)];
    const Eigen::Vector3d turned = view.left_from_board.rotation * on_board(p.pattern, corner);
    Eigen::Vector3d here = turned + view.left_from_board.translation_mm;
    const Eigen::Vector3d turned_left = p.right_from_left.rotation * here;
    if constexpr (kEye == 1) here = turned_left + p.right_from_left.translation_mm;
    CameraJacobian by_camera;
    const Eigen::Vector2d pixel = pixel_of(p.camera[kEye], here, by_camera, by_left);
    residual = Eigen::Vector2d(at.x, at.y) - pixel;
    depth_mm = here.z();
    by_own.template leftCols<9>() = by_camera;
    if constexpr (kEye == 1) {
      by_own.template rightCols<6>() << by_left * -cross(turned_left), by_left;
      by_left = (by_left * p.right_from_left.rotation).eval();
    }
    by_pose << by_left * -cross(turned), by_left;
  }
};

}  // namespace relievo::pipeline::bundle
