// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/fit/relation_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "pipeline/base/solving.h"
#include "pipeline/calibrate/fit/bundle.h"

namespace relievo::pipeline {
namespace {

using bundle::cross;
using bundle::Matrix6d;
using bundle::Pose;
using bundle::Vector6d;

struct Miss {
  Vector6d off;      // of the right camera's board, as a step from where it sees it
  Matrix6d by_step;  // of `off` by a step of the relation
  Matrix6d weight;   // of `off`, the left camera's freedom taken out
};

Miss miss_of(const RelationEvidence& view, const Pose& relation) {
  const Eigen::Matrix3d& r = relation.rotation;
  const Eigen::Vector3d turned = r * view.left_from_board.translation_mm;
  Miss miss;
  miss.off.head<3>() =
      bundle::turn_of(r * view.left_from_board.rotation * view.right_from_board.rotation.transpose());
  miss.off.tail<3>() = turned + relation.translation_mm - view.right_from_board.translation_mm;
  miss.by_step.setIdentity();
  miss.by_step.bottomLeftCorner<3, 3>() = -cross(turned);
  Matrix6d carry = Matrix6d::Zero();  // a step of the left board, as one of the right
  carry.topLeftCorner<3, 3>() = r;
  carry.bottomRightCorner<3, 3>() = r;
  const Matrix6d pull = view.right_information * carry;
  const Matrix6d both = view.left_information + carry.transpose() * pull;
  miss.weight = view.right_information - eliminated<6, 6>(both, pull);
  return miss;
}

}  // namespace

std::vector<RelationEvidence> gather_evidence(const CameraFits& cameras, std::span<const int> pairs) {
  std::vector<RelationEvidence> views;
  for (const int pair : pairs) {
    const bundle::View& left = cameras.left.problem.views[cameras.left.place(pair)];
    const bundle::View& right = cameras.right.problem.views[cameras.right.place(pair)];
    views.push_back({left.left_from_board, right.left_from_board, left.information, right.information});
  }
  return views;
}

double misfit_px2(const RelationEvidence& view, const Pose& right_from_left) {
  const Miss miss = miss_of(view, right_from_left);
  return miss.off.dot(miss.weight * miss.off);
}

namespace {

using Direction = Eigen::Matrix<double, 6, 3>;

Direction turned_camera(const Pose& relation) {
  Direction turn;
  turn << Eigen::Matrix3d::Identity(), -cross(relation.translation_mm);
  return turn;
}

Direction carried_board() {
  Direction carry;
  carry << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
  return carry;
}

// The least misfit with `excused` free in every view.
double misfit_but(std::span<const RelationEvidence> views, Pose relation, bool camera_turned) {
  constexpr int kSteps = 4;
  constexpr double kFirm = 1e-9;  // what the story leaves open of the relation stays as it is
  double cost = 0;
  for (int i = 0; i <= kSteps; ++i) {
    Matrix6d sum = Matrix6d::Zero();
    Vector6d pull = Vector6d::Zero();
    cost = 0;
    for (const RelationEvidence& view : views) {
      const Miss miss = miss_of(view, relation);
      const Direction excused =
          camera_turned ? Direction(miss.by_step * turned_camera(relation)) : carried_board();
      const Direction weighted = miss.weight * excused;
      const Eigen::Matrix3d inner = excused.transpose() * weighted;
      const Matrix6d weight = miss.weight - weighted * inner.ldlt().solve(weighted.transpose());
      const Matrix6d by = miss.by_step.transpose() * weight;
      sum += by * miss.by_step;
      pull -= by * miss.off;
      cost += miss.off.dot(weight * miss.off);
    }
    sum.diagonal() *= 1 + kFirm;
    sum.diagonal().array() += kFirm * sum.trace();
    if (i < kSteps) relation.step(solved<6>(sum, pull));
  }
  return cost;
}

}  // namespace

Stories tell_stories(std::span<const RelationEvidence> views, const Pose& right_from_left) {
  return {misfit_but(views, right_from_left, true), misfit_but(views, right_from_left, false)};
}

Pose fit_relation(std::span<const RelationEvidence> views, std::span<const std::size_t> chosen,
                  Pose right_from_left) {
  constexpr int kSteps = 3;
  for (int i = 0; i < kSteps; ++i) {
    Matrix6d sum = Matrix6d::Zero();
    Vector6d pull = Vector6d::Zero();
    for (const std::size_t v : chosen) {
      const Miss miss = miss_of(views[v], right_from_left);
      const Matrix6d weighted = miss.by_step.transpose() * miss.weight;
      sum.noalias() += weighted * miss.by_step;
      pull.noalias() -= weighted * miss.off;
    }
    right_from_left.step(solved<6>(sum, pull));
  }
  return right_from_left;
}

}  // namespace relievo::pipeline
