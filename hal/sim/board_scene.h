// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A printed board in any pose and light. Board frame: origin in the first inner corner, x along a row
// of corners, y down the rows, z into the board; mm.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/result.h"
#include "hal/sim/board_print.h"
#include "hal/sim/optics/rig.h"
#include "hal/sim/optics/scene.h"

namespace relievo::hal::sim {

struct BoardPose {
  Mat3 world_from_board;
  Vec3 origin_mm;  // of the board, in world
  Vec3 to_world(Vec3 p) const { return world_from_board * p + origin_mm; }
};

// What a calibration has to bear; all 0: an even light on a clean board.
struct BoardLook {
  double lamp = 0;             // share of the light lost from the board's left edge to its right
  double shadow = 0;           // share of the light lost in a shadow over a slanting third of the board
  double highlight = 0;        // a lamp's mirror image, half a square wide, in units of white paper
  double cover = 0;            // share of the board's width that a hand reaches over it from the right
  Result<void> check() const;  // InvalidInput
};

class BoardScene final : public Scene {
 public:
  // Where `pixel_rad`, the angle of a pixel, is given, a ray collects the light of a whole pixel, and
  // the camera needs no more than one.
  BoardScene(const BoardPattern& pattern, const BoardPose& pose, const BoardLook& look = {},
             double pixel_rad = 0);
  RayHit look(Vec3 origin, Vec3 direction) const override;
  bool solid(Vec3 origin, Vec3 direction, SolidPoint& out) const override;
  bool blocked(Vec3, Vec3, double) const override { return false; }
  Mesh solid_mesh() const override;

 private:
  struct Hit {
    double distance = 0, x = 0, y = 0;  // mm, on the board
  };
  bool meet(Vec3 origin, Vec3 direction, Hit& hit) const;
  bool covered(const Hit& hit) const;
  double light(Vec3 origin, Vec3 direction, const Hit& hit) const;
  double dark_share(Vec3 origin, Vec3 direction, const Hit& hit) const;

  BoardPattern pattern_;
  BoardPrint print_;
  BoardPose pose_;
  BoardLook look_;
  double pixel_rad_;
};

// Poses that show the whole board to both cameras, tilted and spread as a good calibration wants.
// PoorGeometry when the rig cannot see this board whole.
Result<std::vector<BoardPose>> good_board_poses(const SimRig& rig, const BoardPattern& pattern, int count,
                                                std::uint32_t seed, double distance_mm = 560);

}  // namespace relievo::hal::sim
