// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibrate/live/candidate_poses.h"

#include <cmath>
#include <numbers>

#include "pipeline/calibrate/quality/rig_geometry.h"

namespace relievo::pipeline {
namespace {

constexpr double kDistances[] = {1, 0.8, 1.25};  // of the distance wanted
constexpr double kTiltRad = 0.7;                 // 40 degrees: enough for a full skew bar
constexpr int kTilts = 9;                        // facing, then eight ways round the compass
constexpr double kTurnRad = 0.6;                 // about the line of sight, in the middle only
constexpr double kEdgeShare = 0.03;              // of the picture stays free
constexpr int kOutSteps = 20;

class Rig {
 public:
  explicit Rig(const bundle::Problem& rig) : rig_(rig) {}

  bundle::Pose in(int eye, const bundle::Pose& left_from_board) const {
    const bundle::Pose& relation = rig_.right_from_left;
    if (eye == 0) return left_from_board;
    return {relation.rotation * left_from_board.rotation,
            relation.rotation * left_from_board.translation_mm + relation.translation_mm};
  }
  Vec2d project(int eye, const bundle::Pose& left_from_board, double column, double row) const {
    const double square = rig_.pattern.square_mm;
    return bundle::project(rig_.camera[static_cast<std::size_t>(eye)], in(eye, left_from_board),
                           column * square, row * square);
  }
  // With the squares around the outer corners.
  bool seen_whole(const bundle::Pose& left_from_board) const {
    for (const int eye : {0, 1}) {
      const CameraIntrinsics& camera = rig_.camera[static_cast<std::size_t>(eye)];
      const double edge_px = kEdgeShare * camera.width_px;
      for (const double column : {-1, rig_.pattern.columns})
        for (const double row : {-1, rig_.pattern.rows}) {
          const double square = rig_.pattern.square_mm;
          const bundle::Pose pose = in(eye, left_from_board);
          if ((pose.rotation * Eigen::Vector3d(column * square, row * square, 0) + pose.translation_mm).z() <
              1)
            return false;
          const Vec2d at = project(eye, left_from_board, column, row);
          if (!(at.x > edge_px && at.y > edge_px && at.x < camera.width_px - edge_px &&
                at.y < camera.height_px - edge_px))
            return false;
        }
    }
    return true;
  }
  Eigen::Vector3d middle_mm() const {
    const double square = rig_.pattern.square_mm;
    return {0.5 * (rig_.pattern.columns - 1) * square, 0.5 * (rig_.pattern.rows - 1) * square, 0};
  }
  const bundle::Problem& problem() const { return rig_; }

 private:
  const bundle::Problem& rig_;
};

// As far towards (across, down) from the picture's middle as it stays whole; false where it never is.
bool place(const Rig& rig, const Eigen::Matrix3d& rotation, double distance_mm, int across, int down,
           bundle::Pose& pose) {
  const CameraIntrinsics& camera = rig.problem().camera[0];
  pose.rotation = rotation;
  for (int step = across == 0 && down == 0 ? 0 : kOutSteps; step >= 0; --step) {
    const double out = 0.5 * step / kOutSteps;
    const Vec2d at = {(0.5 + out * across) * camera.width_px, (0.5 + out * down) * camera.height_px};
    pose.translation_mm = distance_mm * ray_of(camera, at) - rotation * rig.middle_mm();
    if (rig.seen_whole(pose)) return step > 0 || (across == 0 && down == 0);
  }
  return false;
}

Eigen::Matrix3d tilted(int tilt) {
  if (tilt == 0) return Eigen::Matrix3d::Identity();
  const double compass = (tilt - 1) * std::numbers::pi / 4;
  return bundle::rotation_of(kTiltRad * Eigen::Vector3d(std::cos(compass), std::sin(compass), 0));
}

Eigen::Matrix3d turned(double by_rad) { return bundle::rotation_of(by_rad * Eigen::Vector3d::UnitZ()); }

CandidatePose seen_in(const Rig& rig, std::size_t number, const bundle::Pose& pose) {
  CandidatePose candidate{number, pose, {}};
  const BoardPattern& pattern = rig.problem().pattern;
  for (int eye = 0; eye < 2; ++eye)
    for (int row = 0; row < pattern.rows; ++row)
      for (int column = 0; column < pattern.columns; ++column)
        candidate.corners[static_cast<std::size_t>(eye)].push_back(rig.project(eye, pose, column, row));
  return candidate;
}

}  // namespace

std::vector<CandidatePose> candidate_poses(const bundle::Problem& problem, double distance_mm,
                                           int quarter_turns) {
  const Rig rig(problem);
  std::vector<CandidatePose> poses;
  std::size_t number = 0;
  const auto add = [&](double distance, int across, int down, int tilt, double turn_rad) {
    ++number;
    bundle::Pose pose;
    const Eigen::Matrix3d rotation = tilted(tilt) * turned(turn_rad + quarter_turns * 0.5 * std::numbers::pi);
    if (place(rig, rotation, distance * distance_mm, across, down, pose))
      poses.push_back(seen_in(rig, number, pose));
  };
  for (const double distance : kDistances)
    for (int tilt = 0; tilt < kTilts; ++tilt) {
      for (int down = -1; down <= 1; ++down)
        for (int across = -1; across <= 1; ++across) add(distance, across, down, tilt, 0);
      if (tilt % 2 == 1 || tilt == 0)
        for (const double turn : {-kTurnRad, kTurnRad}) add(distance, 0, 0, tilt, turn);
    }
  return poses;
}

}  // namespace relievo::pipeline
