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

namespace relievo::firmware {

class StageRunner {
 public:
  virtual ~StageRunner() = default;
  // `stage` is Match, Reconstruct, Mesh or Texture; the products of the stages before are there.
  // Fills in and out of the record.
  virtual Result<void> run(State stage, Products& products, pipeline::StageContext& context,
                           StageRecord& record) = 0;
};

}  // namespace relievo::firmware
