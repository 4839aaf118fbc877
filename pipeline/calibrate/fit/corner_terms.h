// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One corner in one picture: what the fit misses it by, and how its picture follows every parameter.
// Inside fit/ only.
#pragma once

#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline::bundle {

Eigen::Matrix3d cross(const Eigen::Vector3d& v);

using CameraJacobian = Eigen::Matrix<double, 2, 9>;  // of a pixel by fx fy cx cy k1 k2 p1 p2 k3
using PointJacobian = Eigen::Matrix<double, 2, 3>;

// Pixel of a point in the camera's frame, with its derivatives where asked for.
Eigen::Vector2d pixel_of(const CameraIntrinsics& camera, const Eigen::Vector3d& point,
                         CameraJacobian* by_camera, PointJacobian* by_point);

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
    const Vec2d& at = (*view.seen[kEye])[static_cast<std::size_t>(corner)];
    const Eigen::Vector3d board((corner % p.pattern.columns) * p.pattern.square_mm,
                                (corner / p.pattern.columns) * p.pattern.square_mm, 0);
    const Eigen::Vector3d turned = view.left_from_board.rotation * board;
    Eigen::Vector3d here = turned + view.left_from_board.translation_mm;
    const Eigen::Vector3d turned_left = p.right_from_left.rotation * here;
    if constexpr (kEye == 1) here = turned_left + p.right_from_left.translation_mm;
    CameraJacobian by_camera;
    const Eigen::Vector2d pixel = pixel_of(p.camera[kEye], here, &by_camera, &by_left);
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
