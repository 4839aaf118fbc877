// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One reconstruction from picture files, or from a saved one, with progress and Ctrl-C, as several commands
// need it. Owns the memory in which pictures and model lie. Thread: main.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "firmware/arguments/command_line.h"
#include "firmware/base/boot_memory.h"
#include "firmware/base/console.h"
#include "firmware/report/report.h"
#include "firmware/session/session.h"
#include "firmware/work/pipeline_stages.h"
#include "firmware/work/session_document.h"
#include "hal/camera.h"
#include "hal/picture_file.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/recognition_images.h"
#include "pipeline/model/stereo_frame.h"

namespace relievo::firmware {

// PicturePair: the two pictures of one instant, read from files; and the calibration they are for.
// Errors: the reader's; InvalidInput where the sizes differ from each other or from the calibration.
// Each names the file. Thread: any.

struct PicturePair {
  hal::Picture left, right;
  pipeline::StereoFrame frame() const { return {left.view(), right.view(), 0, 0}; }
};

Result<PicturePair> read_pair(const std::filesystem::path& left, const std::filesystem::path& right);

// Is it for pictures this large? `place` is named where it is not.
Result<void> check_size(const pipeline::StereoCalibration& calibration, const hal::CaptureMode& pictures,
                        const std::string& place);

// Of pictures this large; a calibration that does not say for which it is (OpenCV's sample) is taken for
// these. `left` is named where it is not.
Result<pipeline::StereoCalibration> read_calibration_for(const PicturePair& pair,
                                                         const std::filesystem::path& file,
                                                         const std::filesystem::path& left);

class Reconstruction {
 public:
  Reconstruction()
      : memory_(0, budget::kLargestPlan.products, budget::kLargestPlan.scratch), session_(memory_) {}
  // Of one pair, or of several of a head that turned, for which it takes budget::pose_bytes() each beside.
  // `by_hand`: a file of matches (pipeline/match/file/match_text.h), checked before anything is matched.
  // Errors: those of the files, of the settings and of the stages; each names its place.
  Result<void> run(const ReconstructArgs& args, Console& console);
  // A saved one: done again are the stages from `from` on; empty: from the first that the settings or
  // `by_hand` change, or that is missing. Errors: also the document's; InvalidInput for what changes a stage
  // before `from`.
  Result<void> load(const ReconstructArgs& args, Console& console);
  // All of one pair's, whole or not at all, and in its place only after `before`. Errors: the file's, those
  // of `before`.
  Result<void> save(const Path& document, const std::function<Result<void>()>& before) const;
  // The portrait and the range image of the model, in the same memory. Errors: OutOfMemory.
  Result<pipeline::RecognitionImages> draw_images();
  const pipeline::FaceModel& model() const { return *session_.products().model; }
  const Report& report() const { return report_; }
  // The first stage that was done now; Review: all are as they were saved.
  State begun_with() const { return first_; }

 private:
  struct Head;
  Result<void> work(State first, Console& console, const Path& named, bool despite_drift);
  Result<void> run_head(const ReconstructArgs& args, Console& console);
  Result<void> make_head(Head& head, JobControl& control);
  void describe();

  BootMemory memory_;
  EnrolmentSession session_;
  std::vector<std::byte> left_, right_;  // the pictures
  Making making_;
  State first_ = State::Match;
  Report report_;
};

}  // namespace relievo::firmware
