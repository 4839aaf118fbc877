// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// StageRunner: runs one of the stages of the pipeline on a session's products. The seam between
// the state machine and the mathematics: tests put stages here that fail on purpose.
// Errors: the stage's own. Thread: worker.
#pragma once

#include "firmware/machine/transition.h"
#include "firmware/session/session.h"
#include "firmware/work/stage_record.h"
#include "pipeline/base/stage.h"
#include "pipeline/fuse/head_pipeline.h"

namespace relievo::firmware {

class StageRunner {
 public:
  virtual ~StageRunner() = default;
  // `stage` is one of kStages; the products of the stages before are there.
  // Fills in and out of the record.
  virtual Result<void> run(State stage, Products& products, pipeline::StageContext& context,
                           StageRecord& record) = 0;
  // Of a head that turned: one of its pairs, kept in `kept`; and the head of all pairs, the front's first,
  // with the face of that (pipeline/fuse/head_pipeline.h).
  virtual Result<pipeline::HeadPose> measure_pose(const pipeline::StereoFrame& pair,
                                                  pipeline::StageContext& context, Arena& kept) = 0;
  virtual Result<pipeline::FusedHead> fuse(const pipeline::FaceModel& face,
                                           std::span<pipeline::HeadPose> poses,
                                           pipeline::StageContext& context) = 0;
};

}  // namespace relievo::firmware
