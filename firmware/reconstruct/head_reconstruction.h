// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A head from several pairs of picture files, with progress and Ctrl-C. Owns the memory in which the model
// lies: budget.h's arenas, and kPoseBytes for each pair. Thread: main.
#pragma once

#include <optional>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/base/boot_memory.h"
#include "firmware/base/console.h"
#include "firmware/base/page_block.h"
#include "firmware/report/report.h"
#include "firmware/work/pipeline_stages.h"
#include "pipeline/fuse/head_pipeline.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::firmware {

class HeadReconstruction {
 public:
  HeadReconstruction()
      : memory_(0, budget::kOutputArenaBytes, budget::kScratchArenaBytes), output_(memory_.output()) {}
  // `pictures`: left, right of each pair, two or more pairs, the frontal one first. `calibrations`: one, or
  // one a pair. Errors: those of the files, the settings and the stages; each names its place.
  Result<void> run(const std::vector<Path>& pictures, const std::vector<Path>& calibrations,
                   const AlgorithmArgs& algorithms, Console& console,
                   WhenMoved when_moved = WhenMoved::Refuse);
  // As Reconstruction has them.
  Result<pipeline::RecognitionImages> draw_images();
  const pipeline::FaceModel& model() const { return head_->model; }
  const Report& report() const { return report_; }

 private:
  class PairsJob;
  BootMemory memory_;
  Arena output_;
  PageBlock kept_block_;
  std::optional<Arena> kept_;
  std::optional<pipeline::FusedHead> head_;
  Report report_;
};

}  // namespace relievo::firmware
