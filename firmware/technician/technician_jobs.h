// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The jobs behind the technician's pages: RunJob TestShotJob CameraWatchJob CalibrateJob.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/base/boot_memory.h"
#include "firmware/calibrate/calibrate_command.h"
#include "firmware/capture/face_light.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/session/session.h"
#include "firmware/technician/show/technician_figures.h"
#include "firmware/technician/show/technician_pictures.h"
#include "firmware/technician/stick_files.h"
#include "firmware/work/jobs.h"
#include "firmware/work/pipeline_stages.h"
#include "firmware/work/session_document.h"
#include "hal/base/arena.h"
#include "hal/base/image_view.h"
#include "hal/base/thread_pool.h"
#include "hal/recording/capture_file.h"
#include "pipeline/calibrate/live/live_calibration.h"
#include "pipeline/model/calibration.h"
#include "pipeline/model/stereo_frame.h"
#include "ui/technician/technician_view.h"

namespace relievo::firmware {

// RunJob: all stages of the pipeline, or the last of them, on the test capture that lies in the session, with
// the algorithms that were chosen, or a saved reconstruction into the session; then the pictures and figures
// of what came out. A stage that gives up leaves what the stages before it made, and its reason in the
// result: for a technician that is an answer, not an error. TestShotJob takes the capture. Errors of run():
// Cancelled; InvalidInput (algorithms that do not fit together); OutOfMemory; the document's. Thread: order()
// and take_back() main, while the job does not run; run() worker (TestShotJob: capture).
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

// What reliefs are made in: the session's memory may be the worker's meanwhile.
struct ReliefRoom {
  BootMemory memory{0, std::size_t{4} << 20, std::size_t{64} << 20};  // touched: 1 MB and 27 MB
  Arena output{memory.output()}, scratch{memory.scratch()};
  ThreadPool pool{1};
  ~ReliefRoom() { output.wipe(), scratch.wipe(); }
};

// CameraWatch: what both cameras see and how well, for a hand at lens, lamp and cable: pictures, light and
// focus of the middle of each, how far apart the two were exposed, what the grabber has counted, and the
// relief when asked. It watches in the session's free slot, beside the test capture, until it is cancelled.
// Errors of run(): the grabber's; Cancelled. Thread: run() capture; the rest main.
class CameraWatchJob final : public CameraJob {
 public:
  using CameraJob::CameraJob;
  // With the calibration in use; null: there is none, and no relief. While the job does not run.
  void prepare(const pipeline::StereoCalibration* calibration);
  // With every pair its relief, from the next one on.
  void show_relief(bool on) { relief_shown_.store(on, std::memory_order_relaxed); }
  bool shows_relief() const { return relief_shown_.load(std::memory_order_relaxed); }
  // What is in focus is coloured, from the next pair on.
  void show_edges(bool on) { edges_shown_.store(on, std::memory_order_relaxed); }
  bool shows_edges() const { return edges_shown_.load(std::memory_order_relaxed); }
  // A third stop brighter (1) or darker (-1) from the next pair on.
  void change_light(int steps) { steps_.fetch_add(steps, std::memory_order_relaxed); }
  Result<void> run(JobControl& control) override;
  // The newest pair and its figures; `watched` false before the first one.
  ui::TechnicianCameras newest();
  void wipe();

 private:
  Result<void> look(const pipeline::StereoFrame& frame, JobControl& control);
  bool draw_relief(const pipeline::StereoFrame& frame, JobControl& control, ui::TechnicianCameras& now);
  void set_light();
  // Where the rig sees depth and where it does not, as the gate judges by it. Grey8, near is bright, black is
  // unknown; valid until the next one or wipe(). Errors: InvalidState (no calibration), those of LiveRelief,
  // OutOfMemory.
  Result<ImageView> relief_of(const pipeline::StereoFrame& frame, JobControl& control);
  std::array<LiveFeed, 3> feeds_{LiveFeed(budget::kWatchedSidePx), LiveFeed(budget::kWatchedSidePx),
                                 LiveFeed()};  // left, right, relief
  std::array<FocusHelp, 2> focus_;
  FocusPeaking peaking_;
  std::optional<pipeline::StereoCalibration> calibration_;
  std::optional<ReliefRoom> relief_room_;  // the first relief takes it, wipe() gives it back
  std::vector<std::uint8_t> relief_grey_;
  std::atomic<int> steps_{0};
  std::atomic<bool> relief_shown_{false}, edges_shown_{false};
  std::optional<hal::Instant> last_pair_;
  std::mutex mutex_;
  ui::TechnicianCameras figures_;  // without pictures and texts; with those of the feeds, under the mutex
};

// CalibrateJob: a live calibration (pipeline/calibrate/live) on pairs of the cameras, or of whoever holds a
// board before them; its state and its pictures, with the corners seen (green) and the wanted board's outline
// (orange) drawn in, go to the screen. Ends when the calibration is done, when it is told to finish with the
// views it has, or cancelled. Cameras that give no pair are tried again for some seconds; what goes wrong for
// longer, or with a pair itself, ends it, and the views it has are judged all the same.
// Errors of run(): LiveCalibration's and, where the views do not make a calibration, the pairs' own;
// Cancelled. Thread: run() capture; newest(), finish() any; the rest main, while it does not run.

// Who shows boards instead of the cameras; empty: the cameras do.
using ShowBoards = std::function<Result<std::unique_ptr<LivePairs>>(const BoardArgs& board)>;

class CalibrateJob final : public CameraJob {
 public:
  struct Order {
    BoardArgs board;
    std::optional<pipeline::StereoCalibration> in_use;
  };
  CalibrateJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, ThreadPool& pool,
               ShowBoards show)
      : CameraJob(grabber, session, device), pool_(pool), show_(std::move(show)) {}
  void order(const Order& order);
  Result<void> run(JobControl& control) override;
  void finish() { finish_.store(true, std::memory_order_relaxed); }

  // The live part of the view: pictures, advice, bars, all of one pair; and what keeps the next from coming.
  ui::TechnicianCalibration newest();
  const Result<void>& outcome() const { return outcome_; }
  const std::optional<pipeline::CalibratorOutput>& result() const { return result_; }
  void wipe();

 private:
  Result<void> calibrate(JobControl& control);
  // False: there are no more pairs.
  Result<bool> look_at_next(LivePairs& pairs, pipeline::LiveCalibration& live);
  // Goes with the next pair.
  void tell(const Error& trouble);
  bool may_pass(const Error& trouble) const;
  void publish(const LivePair& pair, const pipeline::LiveState& state);

  ThreadPool& pool_;
  ShowBoards show_;
  Order order_;
  std::array<LiveFeed, 2> feeds_;
  std::atomic<bool> finish_{false};
  std::mutex mutex_;
  ui::TechnicianCalibration figures_;  // without pictures, which the feeds have; all under the mutex
  std::optional<pipeline::CalibratorOutput> result_;
  Result<void> outcome_;
};

}  // namespace relievo::firmware
