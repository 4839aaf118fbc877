// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The jobs of the three threads. Each is made once, with the appliance, and started many times.
//   capture: open_cameras() PoseJob GrabJob TurnJob    worker: StageJob HeadJob    keeper: KeeperJob
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/capture/face_light.h"
#include "firmware/capture/live_judge.h"
#include "firmware/capture/stereo_grabber.h"
#include "firmware/jobs/job_thread.h"
#include "firmware/session/session.h"
#include "firmware/work/stage_runner.h"
#include "hal/base/thread_pool.h"
#include "hal/base/wiped_text.h"
#include "hal/clock.h"
#include "hal/device.h"
#include "pipeline/calibrate/drift.h"
#include "pipeline/model/advice.h"
#include "pipeline/model/face_model.h"
#include "storage/record.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

// The records as a visit needs them. Between the threads go values alone, so that none looks into another's:
//
//   main: VisitRecord, RecordQuestion --> keeper: VisitRecords --> main: KeptVisit, RecordAnswer
//
// Errors: the store's, and MediaFull. Thread: the keeper alone calls VisitRecords.

// All that is stored of a visit beside its model.
struct VisitRecord {
  WipedText name;                           // shown; of the new record, if it is one
  std::optional<storage::SubjectId> whose;  // a record that is there already
  bool renews = false;                      // what it held goes
  storage::Consent consent;
  std::uint32_t calibration = 0;  // revision
  std::string calibration_note;   // as the report calls it
  std::string algorithms;
  std::int32_t least_room_mib = 0;  // the disk keeps so much free
  // Added when it is stored:
  std::vector<StageRecord> stages;
  std::optional<pipeline::DriftJudgement> drift;
};

// In place: on its way to the person nothing can fail any more.
struct KeptVisit {
  storage::EnrolmentId enrolment{};
  ShortWipedText<24> receipt;  // for the person's erasure
  ShortWipedText<32> link;     // for where the operator offers their portrait; erases nothing
  storage::WallTime at{};
};

// Is there a record of this name, or of this code?
struct RecordQuestion {
  WipedText name, code;  // no code: the name is asked about
  bool tells_names = true;
};

struct RecordAnswer {
  ui::Known known = ui::Known::NotAsked;
  storage::SubjectId record{};  // of a code
};

class VisitRecords {
 public:
  virtual ~VisitRecords() = default;
  virtual Result<KeptVisit> keep(const VisitRecord& record, const pipeline::FaceModel& model) = 0;
  virtual Result<RecordAnswer> look_up(const RecordQuestion& question) = 0;
};

// A camera that never answered is an error at once; one that was there and vanished is waited for.
Result<void> open_cameras(StereoGrabber& grabber, const hal::CaptureMode& mode, const hal::Clock& clock,
                          JobControl& control);

// One pair, looked at by nobody and wiped; beside the last test capture, which stays. Cameras that are not
// open are opened, so that one that was plugged in is recognised (StereoGrabber::check_cameras()). Errors:
// StereoGrabber's. Thread: capture.
Result<pipeline::StereoFrame> take_and_forget(StereoGrabber& grabber, EnrolmentSession& session,
                                              hal::Device& device, const std::atomic<bool>& cancelled);

// What every job that takes pictures works with.
class CameraJob : public Job {
 public:
  CameraJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device)
      : grabber_(grabber), session_(session), device_(device) {}

 protected:
  StereoGrabber& grabber_;
  EnrolmentSession& session_;
  hal::Device& device_;
};

// Pictures of the person for the screen, with advice, until it is cancelled. Kept are only the newest, small.
// Meanwhile both cameras are set to the light on the face.
class PoseJob final : public CameraJob {
 public:
  PoseJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, ThreadPool& pool,
          LiveJudge* judge)
      : CameraJob(grabber, session, device),
        pool_(pool),
        judge_(judge),
        exposure_(device.left(), device.right()) {}
  Result<void> run(JobControl& control) override;
  // For the shot that follows on the same thread: where the face was last, and the exposure, to be locked.
  const std::optional<FaceBoxes>& face() const { return face_; }
  ExposureControl& exposure() { return exposure_; }

 private:
  Result<ui::LiveView> judge(const pipeline::StereoFrame& frame, JobControl& control);
  Result<void> meter(const pipeline::StereoFrame& frame);

  ThreadPool& pool_;
  LiveJudge* judge_;
  ExposureControl exposure_;
  std::optional<FaceBoxes> face_;
  int pairs_ = 0;
};

// Before a live device a burst at one exposure, else the next pair.
class GrabJob final : public CameraJob {
 public:
  GrabJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, PoseJob& pose)
      : CameraJob(grabber, session, device), pose_(pose) {}
  Result<void> run(JobControl& control) override;

 private:
  void took(const pipeline::StereoFrame& frame);

  PoseJob& pose_;
};

class StageJob : public Job {
 public:
  StageJob(StageRunner& runner, EnrolmentSession& session, ThreadPool& pool, const hal::Clock& clock)
      : runner_(runner), session_(session), pool_(pool), clock_(clock) {}
  void choose(State stage) { stage_ = stage; }
  const StageRecord& record() const { return record_; }  // of the last run
  Result<void> run(JobControl& control) override;

 protected:
  StageRunner& runner_;
  EnrolmentSession& session_;
  // Fills in the record: what work(context) costs, in a scratch arena of its own.
  template <typename Work>
  auto timed(std::string_view name, pipeline::Progress& progress, const std::atomic<bool>& cancelled,
             const Work& work) {
    EnrolmentSession::Scratch scratch(session_);
    pipeline::StageContext context{session_.output(), scratch.arena(), pool_, progress, cancelled};
    record_ = {name};
    const hal::Instant begin = clock_.now();
    auto done = work(context);
    record_.took = clock_.now() - begin;
    record_.arena_peak_bytes = session_.output().used() + scratch.arena().high_water();
    return done;
  }
  ThreadPool& pool_;
  const hal::Clock& clock_;
  StageRecord record_;

 private:
  State stage_ = State::Match;
};

// What it works with is given before it starts, what it found taken when it has ended: both by the main
// thread.
template <typename Given, typename Found>
class KeeperJob final : public Job {
 public:
  using Work = std::function<Result<void>(const Given& given, Found& found, JobControl& control)>;
  explicit KeeperJob(Work work) : work_(std::move(work)) {}
  void give(Given given) { given_ = std::move(given); }
  Found take() { return std::exchange(found_, {}); }
  Result<void> run(JobControl& control) override { return work_(given_, found_, control); }

 private:
  Work work_;
  Given given_;
  Found found_;
};

// TurnJob: follows the head that turns after the frontal picture, on the screen as in a mirror, and takes
// each side by itself when it is there and slow. It ends when every side is taken, when finish() says that is
// enough, when no new side has come for kTurnPatience, or where the head cannot be followed; the sides that
// are there are in the session. The light stays as it was set for the front. Works on one thread and in the
// session's follow_block(): the worker has the rest. Thread: run() capture, the others main. Errors: those of
// the grabber and of LiveJudge.
class TurnJob final : public CameraJob {
 public:
  TurnJob(StereoGrabber& grabber, EnrolmentSession& session, hal::Device& device, PoseJob& pose,
          LiveJudge* judge)
      : CameraJob(grabber, session, device), pose_(pose), judge_(judge) {}
  // Before it starts: the frontal pair, which lies in the session.
  void begin_with(const pipeline::StereoFrame& front) {
    front_ = front;
    enough_ = false;
  }
  void finish() { enough_ = true; }
  Result<void> run(JobControl& control) override;
  // Of a side: the pair that was looked at, or with a lamp one more in its light.
  Result<void> take(const pipeline::StereoFrame& seen, JobControl& control);

 private:
  Result<void> follow(JobControl& control, Arena& output, Arena& scratch);

  PoseJob& pose_;
  LiveJudge* judge_;
  ThreadPool alone_{1};
  pipeline::StereoFrame front_;
  std::atomic<bool> enough_{false};
};

// HeadJob: beside a head that turns, all stages of its frontal pair; then every side as it comes, and when no
// more come the head of all of them. What goes wrong with a side costs that side: without any that fits, the
// face of the frontal pair stays as it is. Thread: run() worker; parts_done() any; the others main, once it
// has ended. Errors: those of the frontal pair's stages, Cancelled.
class HeadJob final : public StageJob {
 public:
  HeadJob(StageRunner& runner, EnrolmentSession& session, ThreadPool& pool, const hal::Clock& clock)
      : StageJob(runner, session, pool, clock) {
    records_.reserve(kStages.size() + SidePairs::kPoses + 1);
  }
  // Stages, whose pictures may be shown, then sides; PortraitProgress::kFuse from there on.
  std::size_t parts_done() const { return parts_done_.load(std::memory_order_acquire); }
  const std::vector<StageRecord>& records() const { return records_; }
  Result<void> run(JobControl& control) override;
  // What run() does once the frontal pair has its model. `poses`, the front's first, lie in the session's
  // room for them.
  Result<void> add_sides(JobControl& control, std::vector<pipeline::HeadPose>& poses);
  // Why a side was lost; the last one.
  const std::optional<Error>& lost() const { return lost_; }

 private:
  Result<void> measure(const pipeline::StereoFrame& pair, JobControl& control,
                       std::vector<pipeline::HeadPose>& poses);
  Result<void> fuse(JobControl& control, std::vector<pipeline::HeadPose>& poses);
  pipeline::Progress inner_;  // of one part
  std::atomic<std::size_t> parts_done_{0};
  std::vector<StageRecord> records_;
  std::optional<Error> lost_;
};

// PortraitProgress: how far the way from the photograph to the portrait is, as one number that never falls.
// Its parts count as long as they took when they were measured (ms in report.json of `relievo reconstruct`);
// within a part, time itself counts, slower and slower towards the part's end, which may be late. Thread:
// one.
class PortraitProgress {
 public:
  static constexpr std::size_t kFuse = kStages.size() + pipeline::kSides;

  // A new photograph. A head has the face's stages, its sides and their fusion; a face has the stages alone.
  void begin(bool head = false) {
    share_ = 0;
    head_ = head;
    part_ = kFuse + 1;
  }
  // The stages in their order, then the sides, then kFuse.
  void works_on(std::size_t part, hal::Instant now) {
    if (part != part_) begun_ = now;
    part_ = part;
    const auto all = std::span(kParts).first(head_ ? kParts.size() : kStages.size());
    part = std::min(part, all.size() - 1);
    const float passed = std::chrono::duration<float>(now - begun_).count();
    const float so_far = std::accumulate(all.begin(), all.begin() + std::ptrdiff_t(part), 0.0F) +
                         all[part] * (1 - std::exp(-kEase * passed / all[part]));
    share_ = std::max(share_, std::min(kMost, so_far / std::accumulate(all.begin(), all.end(), 0.0F)));
  }
  void done() { share_ = 1; }
  float share() const { return share_; }

 private:
  static constexpr float kEase = 1.6F, kMost = 0.99F;
  static constexpr float kSideS = 0.9F;  // seconds, as the others
  static constexpr std::array<float, kFuse + 1> kParts{0.58F,  0.04F,  0.37F,  0.15F,  0.12F,
                                                       kSideS, kSideS, kSideS, kSideS, 2.2F};
  float share_ = 0;
  bool head_ = false;
  std::size_t part_ = kFuse + 1;
  hal::Instant begun_{};
};

}  // namespace relievo::firmware
