// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A printed board in a hand before a simulated rig of any size, for live calibrations: whoever holds it does
// as told (firmware/demo/hand_pairs.h).
#pragma once

#include <memory>

#include "firmware/demo/hand_pairs.h"
#include "hal/sim/held_board.h"

namespace relievo::firmware {

inline HeldBoard held_board(const hal::sim::RigOptions& rig, const BoardArgs& args) {
  const hal::sim::BoardPattern pattern{args.corners_across,
                                       args.corners_down,
                                       args.square_mm,
                                       0.75 * args.square_mm,
                                       hal::sim::BoardKind::Chessboard,
                                       0,
                                       4};
  hal::sim::SensorOptions sensor;
  sensor.grey = true;
  const auto board = std::make_shared<hal::sim::HeldBoard>(rig, pattern, sensor, 2);
  const auto pose_of = [pattern](const HeldPose& held) {
    return hal::sim::HeldPlace{held.right_mm, held.down_mm,   held.distance_mm,
                               held.yaw_deg,  held.pitch_deg, held.roll_deg}
        .pose(pattern);
  };
  return [board, pose_of](const HeldPose& opened, const HeldPose& closed, std::uint64_t number) {
    auto pair = board->photograph(pose_of(opened), pose_of(closed), number);
    return HeldPair{std::move(pair.left), std::move(pair.right)};
  };
}

}  // namespace relievo::firmware
