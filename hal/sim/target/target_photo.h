// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of calibration boards and acceptance artefacts, as the simulated rig takes them.
// The same numbers give the same pictures. Thread: any; makes `threads` - 1 of its own meanwhile.
// Errors: InvalidInput, PoorGeometry (the rig does not see the whole target).
#pragma once

#include <cstdint>

#include "hal/sim/render.h"
#include "hal/sim/target/artefact_scene.h"

namespace relievo::hal::sim {

struct TargetPhotoOptions {
  RigOptions rig;
  SensorOptions sensor;
  std::uint32_t seed = 1;  // of the noise, and of the boards' poses
  int threads = 2;
};

// Where an artefact stands: its middle in the left camera's frame, turned about x, then y, then z.
struct ArtefactPlace {
  double right_mm = 0, down_mm = 0, distance_mm = 560;
  double pitch_deg = 0, yaw_deg = 0, roll_deg = 0;
  ArtefactPose pose() const;
};

// The `number`th of `count` boards in good poses (good_board_poses), in grey.
Result<PicturePair> photograph_board(const TargetPhotoOptions& options, const BoardPattern& board, int number,
                                     int count);
Result<PicturePair> photograph_dumbbell(const TargetPhotoOptions& options, const Dumbbell& dumbbell,
                                        const ArtefactPlace& place);
Result<PicturePair> photograph_plate(const TargetPhotoOptions& options, const FlatPlate& plate,
                                     const ArtefactPlace& place);

}  // namespace relievo::hal::sim
