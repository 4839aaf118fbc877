// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/quality/known_squares.h"

#include <algorithm>
#include <cmath>

#include "pipeline/calibrate/quality/rig_geometry.h"

namespace relievo::pipeline {
namespace {

struct Points {
  Cloud board;     // as the squares say
  Cloud expected;  // where the left camera sees them, by the size of the squares
  Cloud found;     // by both cameras
};

// Empty where the view cannot be placed.
Points points_of(const bundle::Problem& rig, const BoardView& view, const bundle::Pose& near) {
  bundle::Problem left;
  left.pattern = rig.pattern;
  left.camera = rig.camera;
  left.views.assign(1, {&view.left, nullptr, near});
  if (!bundle::solve_poses(left)) return {};
  const bundle::Pose& pose = left.views[0].left_from_board;
  const auto most = static_cast<Eigen::Index>(view.left.size());
  Points points{Cloud(3, most), Cloud(3, most), Cloud(3, most)};
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < view.left.size(); ++i) {
    if (!seen(view.left[i]) || !seen(view.right[i])) continue;
    const int n = static_cast<int>(i);
    const Eigen::Vector3d on_board(n % rig.pattern.columns * rig.pattern.square_mm,
                                   n / rig.pattern.columns * rig.pattern.square_mm, 0);
    points.board.col(count) = on_board;
    points.expected.col(count) = pose.rotation * on_board + pose.translation_mm;
    points.found.col(count) = point_of(rig, view.left[i], view.right[i]);
    ++count;
  }
  for (Cloud* cloud : {&points.board, &points.expected, &points.found}) cloud->conservativeResize(3, count);
  return points;
}

double squared(double value) { return value * value; }

}  // namespace

KnownSquares measure_known_squares(const Fitted& f, const RigSpread& spread, double distance_mm) {
  double boards = 0;
  double corners = 0;
  double lengths = 0;
  double views = 0;
  double all = 0;
  for (std::size_t i = 0; i < f.selection.used.size(); ++i) {
    const Points p =
        points_of(spread.without()[i], f.input.views[static_cast<std::size_t>(f.selection.used[i])],
                  f.selection.fit.problem.views[i].left_from_board);
    if (p.found.cols() < 4) continue;
    const Eigen::ArrayXd off = (p.found.row(2) - p.expected.row(2)).transpose().array() *
                               (distance_mm / p.expected.row(2).transpose().array()).square();
    boards += squared(off.mean());
    corners += off.square().sum();
    lengths += squared(scale_between(p.board, p.found) - 1);
    all += static_cast<double>(off.size());
    views += 1;
  }
  views = std::max(views, 1.0);
  return {std::sqrt(boards / views), std::sqrt(corners / std::max(all, 1.0)),
          100 * std::sqrt(lengths / views)};
}

}  // namespace relievo::pipeline
