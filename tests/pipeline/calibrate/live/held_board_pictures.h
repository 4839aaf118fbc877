// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of a board in a hand, by the simulated rig, and where its corners truly are.
#pragma once

#include <algorithm>
#include <cmath>

#include "hal/sim/held_board.h"
#include "tests/pipeline/calibrate/live/held_board.h"

namespace relievo::tests {

inline hal::sim::BodyPose pose_of(const BoardAt& at, const pipeline::BoardPattern& pattern) {
  const hal::sim::HeldPlace place{at.right_mm, at.down_mm,   at.distance_mm,
                                  at.yaw_deg,  at.pitch_deg, at.roll_deg};
  return place.pose(hal::sim::BoardPattern{pattern.columns, pattern.rows, pattern.square_mm});
}

class HeldBoardPictures {
 public:
  HeldBoardPictures(int width_px, int height_px, const pipeline::BoardPattern& pattern = {10, 7, 20})
      : pattern_(pattern), board_(rig_options(width_px, height_px), print(pattern), sensor(), 2) {}

  const pipeline::BoardPattern& pattern() const { return pattern_; }
  hal::sim::PicturePair pair(const BoardAt& opened, const BoardAt& closed) {
    return board_.photograph(pose_of(opened, pattern_), pose_of(closed, pattern_), ++number_);
  }
  hal::sim::PicturePair pair(const BoardAt& at) { return pair(at, at); }
  hal::Picture left(const BoardAt& at) { return pair(at).left; }
  hal::Picture left(const BoardAt& opened, const BoardAt& closed) { return pair(opened, closed).left; }

  // How far corners are from where they truly are; those that were not seen count for nothing.
  double seen_rms_px(int eye, const pipeline::BoardCorners& corners, const BoardAt& at) const {
    const auto& view = eye == 0 ? board_.rig().left : board_.rig().right;
    const auto pose = pose_of(at, pattern_);
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!pipeline::seen(corners[i])) continue;
      const int corner = static_cast<int>(i);
      const auto p = view.project(pose.to_world({corner % pattern_.columns * pattern_.square_mm,
                                                 corner / pattern_.columns * pattern_.square_mm, 0}));
      sum += (corners[i].x - p.x) * (corners[i].x - p.x) + (corners[i].y - p.y) * (corners[i].y - p.y);
      ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : 1e9;
  }
  // The same of a board that may be counted from its other end.
  double rms_px(int eye, const pipeline::BoardCorners& corners, const BoardAt& at) const {
    return std::min(seen_rms_px(eye, corners, at), seen_rms_px(eye, {corners.rbegin(), corners.rend()}, at));
  }
  const hal::sim::SimRig& rig() const { return board_.rig(); }

 private:
  static hal::sim::RigOptions rig_options(int width_px, int height_px) {
    hal::sim::RigOptions options;
    options.width_px = width_px;
    options.height_px = height_px;
    return options;
  }
  static hal::sim::BoardPattern print(const pipeline::BoardPattern& pattern) {
    hal::sim::BoardPattern print;
    print.corners_x = pattern.columns;
    print.corners_y = pattern.rows;
    print.square_mm = pattern.square_mm;
    if (pattern.kind == pipeline::BoardKind::Charuco) print.kind = hal::sim::BoardKind::Charuco;
    print.marker_mm = pattern.marker_mm;
    print.marker_bits = pattern.marker_bits;
    return print;
  }
  static hal::sim::SensorOptions sensor() {
    hal::sim::SensorOptions options;
    options.grey = true;
    return options;
  }

  pipeline::BoardPattern pattern_;
  hal::sim::HeldBoard board_;
  std::uint64_t number_ = 0;
};

}  // namespace relievo::tests
