// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// HeadPipeline: a head from several pairs of pictures, between which it turned. The first pair is the master:
// it gives the frame, the landmarks, the verdict whether it is a face, and the expression.
//
//   every pair  -> measure() \                                                     / texture_head()
//                             > register_poses() -> HeadFuser -> one FaceMesh -> <
//   master pair -> face()    /                                                     \ quality of the whole
//
// The face may also be what Pipeline made of the master pair, with its texture. Each pair may have a
// calibration of its own. What is kept of a pose lies in `kept`: 32 bytes a node of its lattice and both
// rectified photographs, at 1920 x 1200 at most 24 MiB. Thread: worker; holds no state between calls.
#pragma once

#include <span>

#include "pipeline/fuse/aliveness.h"
#include "pipeline/fuse/head_fuser.h"
#include "pipeline/fuse/pose_registration.h"
#include "pipeline/pipeline.h"

namespace relievo::pipeline {

struct FusedHead {
  FaceModel model;  // in the first pair's left camera's frame
  Registration registration;
  Aliveness aliveness{};
};

class HeadPipeline {
 public:
  // Errors: those of Pipeline::make.
  static Result<HeadPipeline> make(const AlgorithmSet& set);

  // The stages' errors. `context.output` may be reset once it has returned.
  Result<HeadPose> measure(const StereoFrame& frame, const StereoCalibration& calibration,
                           StageContext& context, Arena& kept) const;
  // Of the master pair alone, without texture. The stages' errors.
  Result<FaceModel> face(const StereoFrame& frame, const StereoCalibration& calibration,
                         StageContext& context) const;
  // Lays the last pose onto those before it, the master's first, so that `fuse` has less to do. To be called
  // after each but the first, or not at all: the head is the same.
  Result<void> place_last(const FaceModel& face, std::span<HeadPose> poses, StageContext& context) const;
  // `poses`: the master's first, whose face it is; they are bent. Where its eyes were not alive the model is
  // `unjudged`, unless nobody asked (relief=off). A pair that fits none of the others is left out. Errors:
  // InvalidInput (a face without its tip of the nose, no pair or more than seven), PoorGeometry (all pairs
  // but the master's are left out; names the first of them), Cancelled, OutOfMemory.
  Result<FusedHead> fuse(const FaceModel& face, std::span<HeadPose> poses, StageContext& context) const;

 private:
  explicit HeadPipeline(const AlgorithmSet& set) : face_set_(set), head_set_(set) {}
  AlgorithmSet face_set_, head_set_;  // they differ in how far from the nose is measured
  HeadFuser fuser_;
  bool asks_for_life_ = false;  // as the relief check is asked for
};

}  // namespace relievo::pipeline
