// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RunJob: all stages of the pipeline, or the last of them, on the test capture that lies in the session, with
// the algorithms that were chosen, or a saved reconstruction into the session; then the pictures and figures
// of what came out. A stage that gives up leaves what the stages before it made, and its reason in the
// result: for a technician that is an answer, not an error. TestShotJob takes the capture. Errors of run():
// Cancelled; InvalidInput (algorithms that do not fit together); OutOfMemory; the document's. Thread: order()
// and take_back() main, while the job does not run; run() worker (TestShotJob: capture).
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/technician/show/technician_figures.h"
#include "firmware/technician/show/technician_pictures.h"
#include "firmware/technician/stick_files.h"
#include "firmware/work/jobs.h"
#include "firmware/work/pipeline_stages.h"
#include "firmware/work/session_document.h"
#include "hal/recording/capture_file.h"

namespace relievo::firmware {

class RunJob final : public Job {
 public:
  RunJob(EnrolmentSession& session, ThreadPool& pool, const hal::Clock& clock)
      : session_(session), pool_(pool), clock_(clock) {}
  // What is in the session from now on is called.
  void name(std::string capture) { name_ = std::move(capture); }
  // The stages from `first` on; those before it are done, and stay.
  // `by_hand`: matches beside the matcher's.
  void order(const pipeline::AlgorithmSet& set, const pipeline::StereoCalibration& calibration, State first,
             std::vector<pipeline::Match> by_hand, bool whole_view = false);
  // No stage, but what was saved of all of them; `making` is making_of(it).
  void order(SavedBytes document, Making making);
  // An order whose run never began: all is as before it. False: there is none.
  bool take_back();
  Result<void> run(JobControl& control) override;

  State stage() const { return now_.load(std::memory_order_relaxed); }  // any thread
  TechnicianPictures& pictures() { return pictures_; }
  TechnicianFigures& figures() { return figures_; }
  HandChange& change() { return change_; }
  // Of what is in the session.
  const Making& making() const { return making_; }
  // The same with these pairs by hand, of the rectified pair: nothing that was calculated with others is
  // done.
  Making making_with(std::vector<pipeline::Match> by_hand) const;

 private:
  Result<void> load(JobControl& control);
  // The surface without pairs by hand, which those change; of what is done, only the matches stay.
  Result<void> before_pairs(PipelineStages& stages, StageJob& job, JobControl& control);
  // The pairs that were taken of its sides: the model becomes the head of all.
  Result<void> add_sides(PipelineStages& stages, JobControl& control, std::vector<pipeline::HeadPose>& poses);
  Result<void> finish(JobControl& control, std::span<const pipeline::HeadPose> poses);
  bool wants_before() const { return !making_.by_hand.empty() && !change_.has_before(making_.set); }

  EnrolmentSession& session_;
  ThreadPool& pool_;
  const hal::Clock& clock_;
  std::string name_;
  Making making_;
  std::optional<Making> before_;  // the order that waits for its run
  State first_ = State::Match;
  std::optional<SavedBytes> document_;  // to be loaded
  TechnicianPictures pictures_;
  TechnicianFigures figures_;
  HandChange change_;
  std::atomic<State> now_{State::Match};
};

class TestShotJob final : public CameraJob {
 public:
  TestShotJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, ThreadPool& pool)
      : CameraJob(grabber, session, device),
        nobody_(grabber, session, device, pool, nullptr),
        grab_(grabber, session, device, nobody_),
        turn_(grabber, session, device, nobody_, nullptr) {}
  // Of the next run: one more pair of the same head, turned, beside the capture.
  void order(bool side) { side_ = side; }
  bool is_side() const { return side_; }
  Result<void> run(JobControl& control) override {
    Result<void> taken = side_ ? take_side(control) : grab_.run(control);
    as_taken_.left_serial = device_.left().serial();
    as_taken_.right_serial = device_.right().serial();
    if (side_) return taken;
    const hal::Exposure light = device_.left().exposure();
    as_taken_.exposure_us = light.time.count();
    as_taken_.gain = light.gain;
    return taken;
  }
  // Exposure and cameras of the capture: they may be set anew before it is recorded.
  const hal::RecordedPair& as_taken() const { return as_taken_; }

 private:
  Result<void> take_side(JobControl& control);

  PoseJob nobody_;  // never runs: no face was found, and no light metered, before the shot
  GrabJob grab_;
  TurnJob turn_;                // takes a side, follows nobody
  hal::RecordedPair as_taken_;  // without pictures
  bool side_ = false;
};

}  // namespace relievo::firmware
