// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeldBoard: a printed board in a hand, photographed many times a second: both cameras at the same instant,
// blurred by whatever it moves while the shutter is open. Even light, a clean board. The same poses and the
// same seed give the same pictures, for any number of threads. Thread: one caller; it uses its own pool.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/thread_pool.h"
#include "hal/sim/board_scene.h"
#include "hal/sim/optics/exposure.h"
#include "hal/sim/optics/rig.h"
#include "hal/sim/render.h"

namespace relievo::hal::sim {

// The board's middle in the world, mm. Turned by roll about the line of sight (clockwise in the picture),
// then by pitch (upper edge nearer), then by yaw (left edge nearer).
struct HeldPlace {
  double right_mm = 0, down_mm = 0, distance_mm = 560;
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  BodyPose pose(const BoardPattern& pattern) const;
};

class HeldBoard {
 public:
  // Options and pattern have been checked. `threads` counts the caller.
  HeldBoard(const RigOptions& rig, const BoardPattern& pattern, const SensorOptions& sensor, int threads);

  const SimRig& rig() const { return rig_; }
  // The board is at `opened` when the shutter opens and at `closed` when it closes; in between it moves
  // evenly. Turns of a few degrees, please.
  PicturePair photograph(const BodyPose& opened, const BodyPose& closed, std::uint64_t noise_seed);

 private:
  struct Eye {
    SimView view;
    std::vector<float> plane_x, plane_y;  // of each pixel's ray, on the plane z = 1 of the camera
  };
  class Shot;
  void prepare(const SimView& view, Eye& eye);
  Picture photograph(const Eye& eye, const BodyPose& opened, const BodyPose& closed,
                     std::uint64_t noise_seed);
  Picture develop(const std::vector<float>& light, const Eye& eye, std::uint64_t noise_seed);

  SimRig rig_;
  BoardPattern pattern_;
  BoardPrint print_;
  SensorOptions sensor_;
  ThreadPool pool_;
  Eye left_, right_;
  std::vector<std::uint8_t> tone_;  // of light in 4096 steps
  std::vector<float> normal_;       // noise of deviation 1, drawn from by hash
};

}  // namespace relievo::hal::sim
