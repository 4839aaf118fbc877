// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One reconstruction from picture files, or from a saved one, with progress and Ctrl-C, as several commands
// need it. Owns the memory in which pictures and model lie. Thread: main.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/base/boot_memory.h"
#include "firmware/base/console.h"
#include "firmware/base/page_block.h"
#include "firmware/report/report.h"
#include "firmware/session/session.h"
#include "firmware/work/pipeline_stages.h"
#include "firmware/work/session_document.h"
#include "pipeline/fuse/head_pipeline.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::firmware {

class Reconstruction {
 public:
  Reconstruction()
      : memory_(0, budget::kLargestPlan.products, budget::kLargestPlan.scratch), session_(memory_) {}
  // `by_hand`: a file of matches (pipeline/match/file/match_text.h), checked before anything is matched;
  // empty: none. Errors: those of the files, of the settings and of the stages; each names its place.
  Result<void> run(const Path& left, const Path& right, const Path& calibration,
                   const AlgorithmArgs& algorithms, const Path& by_hand, Console& console,
                   WhenMoved when_moved = WhenMoved::Refuse);
  // A saved reconstruction; done again are the stages from `from` on ("match" ... "assemble"; empty: from the
  // first that the settings or `by_hand` change, or that is missing). `by_hand`: in place of the saved ones;
  // empty: those stay. Errors: also the document's; InvalidInput for what changes a stage before `from`.
  Result<void> load(const Path& document, std::string_view from, const AlgorithmArgs& algorithms,
                    const Path& by_hand, Console& console, WhenMoved when_moved);
  // All of it, whole or not at all. Errors: the file's.
  Result<void> save(const Path& document) const;
  // The portrait and the range image of the model, in the same memory. Errors: OutOfMemory.
  Result<pipeline::RecognitionImages> draw_images();
  const pipeline::FaceModel& model() const { return *session_.products().model; }
  const Report& report() const { return report_; }
  // The first stage that was done now; Review: all are as they were saved.
  State begun_with() const { return first_; }

 private:
  Result<void> work(State first, Console& console, const Path& named, WhenMoved when_moved);

  BootMemory memory_;
  EnrolmentSession session_;
  std::vector<std::byte> left_, right_;  // the pictures
  Making making_;
  State first_ = State::Match;
  Report report_;
};

// A head from several pairs of picture files, with progress and Ctrl-C. Owns the memory in which the model
// lies: budget.h's arenas, and pose_bytes() for each pair. Thread: main.
class HeadReconstruction {
 public:
  HeadReconstruction()
      : memory_(0, budget::kLargestPlan.products, budget::kLargestPlan.scratch), output_(memory_.output()) {}
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
