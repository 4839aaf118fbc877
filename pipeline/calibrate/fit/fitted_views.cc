// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/fitted_views.h"

#include "pipeline/calibrate/fit/stereo_fit.h"

namespace relievo::pipeline {
namespace {

bundle::Pose right_from_board(const bundle::Problem& p, const bundle::Pose& left_from_board) {
  const bundle::Pose& relation = p.right_from_left;
  return {relation.rotation * left_from_board.rotation,
          relation.rotation * left_from_board.translation_mm + relation.translation_mm};
}

std::vector<CornerResidual> residuals(const BoardPattern& pattern, const CameraIntrinsics& camera,
                                      const bundle::Pose& camera_from_board, const BoardCorners& corners) {
  std::vector<CornerResidual> all;
  all.reserve(corners.size());
  for (int i = 0; i < pattern.corners(); ++i) {
    const Vec2d& at = corners[std::size_t(i)];
    const Vec2d put = bundle::project(camera, camera_from_board, i % pattern.columns * pattern.square_mm,
                                      i / pattern.columns * pattern.square_mm);
    // A corner that was not seen is not-a-number, and so is its residual.
    all.push_back({at, {at.x - put.x, at.y - put.y}});
  }
  return all;
}

RigidTransform transform_of(const bundle::Pose& pose) {
  RigidTransform t;
  for (int i = 0; i < 9; ++i) t.rotation.m[i] = pose.rotation(i / 3, i % 3);
  t.translation_mm = {pose.translation_mm.x(), pose.translation_mm.y(), pose.translation_mm.z()};
  return t;
}

}  // namespace

std::vector<FittedView> fitted_views(std::size_t count, const StereoFit& fit) {
  std::vector<FittedView> views(count);
  const bundle::Problem& p = fit.problem;
  for (std::size_t k = 0; k < fit.views.size(); ++k) {
    const bundle::View& from = p.views[k];
    FittedView& view = views[std::size_t(fit.views[k])];
    const bundle::Pose& pose = from.left_from_board;
    if (from.seen[0] != nullptr) view.left = residuals(p.pattern, p.camera[0], pose, *from.seen[0]);
    if (from.seen[1] != nullptr)
      view.right = residuals(p.pattern, p.camera[1], right_from_board(p, pose), *from.seen[1]);
    if (!view.placed || from.seen[0] != nullptr) view.left_from_board = transform_of(pose);
    view.placed = true;
  }
  return views;
}

}  // namespace relievo::pipeline
