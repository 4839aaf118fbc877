// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A printed chessboard in any pose. Board frame: origin in the first inner corner, x along a row
// of corners, y down the rows, z into the board; mm.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/result.h"
#include "hal/sim/rig.h"
#include "hal/sim/scene.h"

namespace relievo::hal::sim {

struct BoardPattern {
  int corners_x = 10, corners_y = 7;   // inner corners
  double square_mm = 20;
  double margin_mm = 15;               // white, around the outer squares
  Result<void> check() const;
};

struct BoardPose {
  Mat3 world_from_board;
  Vec3 origin_mm;                      // of the board, in world
  Vec3 to_world(Vec3 p) const { return world_from_board * p + origin_mm; }
};

class BoardScene final : public Scene {
 public:
  BoardScene(const BoardPattern& pattern, const BoardPose& pose) : pattern_(pattern), pose_(pose) {}
  Sight look(Vec3 origin, Vec3 direction) const override;
  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override;
  bool blocked(Vec3, Vec3, double) const override { return false; }
  Mesh solid_mesh() const override;

 private:
  bool meet(Vec3 origin, Vec3 direction, double& distance, double& x, double& y) const;
  BoardPattern pattern_;
  BoardPose pose_;
};

// Poses that show the whole board to both cameras, tilted and spread as a good calibration wants.
// PoorGeometry when the rig cannot see this board whole.
Result<std::vector<BoardPose>> good_board_poses(const SimRig& rig, const BoardPattern& pattern, int count, std::uint32_t seed,
                                                double distance_mm = 560);

}  // namespace relievo::hal::sim
