// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One reconstruction from picture files, with progress and Ctrl-C, as several commands need it.
// Owns the memory in which the model lies. Thread: main.
#pragma once

#include <filesystem>

#include "firmware/boot_memory.h"
#include "firmware/command/console.h"
#include "firmware/command/line/command_line.h"
#include "firmware/command/reconstruct/report.h"
#include "firmware/session.h"
#include "firmware/work/pipeline_stages.h"
#include "pipeline/model/recognition_images.h"

namespace relievo::firmware {

class Reconstruction {
 public:
  Reconstruction() : memory_(0, budget::kOutputArenaBytes, budget::kScratchArenaBytes), session_(memory_) {}
  // Errors: those of the files, of the settings and of the stages; each names its place.
  Result<void> run(const Path& left, const Path& right, const Path& calibration, const AlgorithmArgs& algorithms,
                   Console& console, WhenMoved when_moved = WhenMoved::Refuse);
  // The portrait and the range image of the model, in the same memory. Errors: OutOfMemory.
  Result<pipeline::RecognitionImages> draw_images();
  const pipeline::FaceModel& model() const { return *session_.products().model; }
  const Report& report() const { return report_; }

 private:
  BootMemory memory_;
  EnrolmentSession session_;
  Report report_;
};

}  // namespace relievo::firmware
