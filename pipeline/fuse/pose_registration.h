// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds how the head turned between the pictures: for every pose the rigid motion into the first one's left
// camera's frame. All poses at once, each against each: what a pose measured is laid onto every other one's
// surface (point to plane; Chen, Medioni 1992, projected as Blais, Levine 1995), with a redescending weight
// (Geman, McClure 1987) that narrows to the noise. A living face moves: forehead, temples, the bridge of the
// nose, the sides and the ears count, lids, lips, jaw and neck hardly do. Beside its shape the skin's
// photographs count (`fuse/skin_slide.cc`): shape alone hardly tells whether a head slid along its own
// surface. Skin slides, too, the less the nearer it hangs on the skull. Where skin moves, its patches count
// alike, however well each was measured. The covariance holds how far regions of skin were seen to move, each
// as one: what one region moved is one observation and not a thousand. Millimetres, radians.
#pragma once

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "pipeline/base/stage.h"
#include "pipeline/fuse/head_pose.h"

namespace relievo::pipeline {

inline constexpr int kMostPoses = 7;

// What one pose shows of the skin that another one shows, too, all of it and as it was measured: before the
// fuser bends anything.
struct PoseMeeting {
  double overlap_mm2 = 0;
  double rms_mm = 0, p95_mm = 0;  // along the normals; 0 where they do not meet
};

struct RegisteredPose {
  RigidTransform first_from_pose;
  // Of a small motion after it, in the first pose's frame about the middle of the head (`pivot_mm`): rotation
  // vector, then translation; row by row.
  std::array<double, 36> covariance{};
  double rms_mm = 0;  // of the skin that counts, from the other poses' surfaces
  bool joined = true;
  std::array<PoseMeeting, kMostPoses> meets{};  // each of the others
};

// By how much a pose's surface lies before the mean of the others', at every fourth node of its lattice; NaN
// where none of them shows anything within 3 mm.
inline constexpr int kResidualEvery = 4;
struct ResidualMap {
  explicit ResidualMap(std::pmr::memory_resource* memory) : mm(memory) {}
  int columns = 0, rows = 0;
  std::pmr::vector<float> mm;  // row by row
};

struct Registration {
  explicit Registration(std::pmr::memory_resource* memory) : poses(memory), residuals(memory) {}
  std::pmr::vector<RegisteredPose> poses;   // the first is the identity, its covariance 0
  std::pmr::vector<ResidualMap> residuals;  // of each
  Vec3d pivot_mm;
  double skin_moved_mm = 0;  // how far a region of skin lies from where a stiff head has it: one sigma
};

// The first pose must have a head frame; others start from theirs, or, where that leads nowhere, from a head
// turned by 25, 45 and 65 degrees to each side or nodding by 20. One that meets no other, or that lies off
// them by more than 1.5 mm (rms), is left out: `joined` is false, and its trust is 0 everywhere. Memory: the
// result in `output`. Errors: InvalidInput (the first has no head frame), PoorGeometry (all others are left
// out; names the first of them), Cancelled. Throws std::bad_alloc. Thread: any. `place_last_pose` does a part
// of it before all poses are there: lays the last of these onto those before it, if it lies well there, and
// finds the skin they share. Memory: scratch; what they share in the pose's own.
void place_last_pose(std::span<HeadPose> poses, StageContext& context);
Result<Registration> register_poses(std::span<HeadPose> poses, StageContext& context);

}  // namespace relievo::pipeline
