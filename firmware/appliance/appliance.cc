// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/appliance/appliance.h"

#include <algorithm>
#include <utility>

#include "firmware/base/budget.h"
#include "hal/base/assert.h"
#include "ui/device/settings.h"
#include "ui/view/visit.h"

namespace relievo::firmware {
namespace {

// Whoever walks away is asked, and leaves, by the page: no state's limit may come before that.
constexpr auto kPageLeavesAfter = std::chrono::seconds(ui::kMostPatienceS) + ui::kLastCall;
static_assert(budget::kPositionLimit > kPageLeavesAfter && budget::kReviewLimit > kPageLeavesAfter);
static_assert(budget::kStaffLimit > std::chrono::seconds(ui::kMostStaffPatienceS));

// Is the machine broken, or was it only this picture?
bool is_fault(Errc code) {
  constexpr std::array kFaults{Errc::Disconnected, Errc::NotCalibrated, Errc::InvalidState,
                               Errc::StoreCorrupt, Errc::StoreNewer};
  return std::ranges::find(kFaults, code) != kFaults.end();
}

Event event_of(ui::Intent intent) {
  switch (intent) {
    case ui::Intent::Pose: return Event::PoseAsked;
    case ui::Intent::Begin: return Event::Begin;
    case ui::Intent::Accept: return Event::Accept;
    case ui::Intent::Retake: return Event::Retake;
    case ui::Intent::Cancel: return Event::Cancel;
    case ui::Intent::LookUp:
    case ui::Intent::StillHere:
    case ui::Intent::Enough:
    case ui::Intent::TakeHome:
    case ui::Intent::StopTaking:
    case ui::Intent::Print: break;  // no event: they give time, end a job, or are the kiosk's
    case ui::Intent::OpenStaff: return Event::StaffIn;
    case ui::Intent::LeaveStaff: return Event::StaffOut;
    case ui::Intent::Calibrate: return Event::CalibrateAsked;
    case ui::Intent::Export: return Event::ExportAsked;
  }
  return Event::Count;
}

}  // namespace

Appliance::Appliance(Parts parts)
    : device_(parts.device),
      machine_(parts.device.clock().now()),
      session_(parts.memory),
      grabber_(parts.device),
      open_cameras_([this](JobControl& control) {
        return open_cameras(grabber_, device_.preferred_mode(), device_.clock(), control);
      }),
      pose_(grabber_, session_, parts.device, parts.pool, parts.judge),
      grab_(grabber_, session_, parts.device, pose_),
      turn_(grabber_, session_, parts.device, pose_, parts.judge),
      stage_(parts.stages, session_, parts.pool, parts.device.clock()),
      head_(parts.stages, session_, parts.pool, parts.device.clock()),
      keep_([this, &records = parts.records](const VisitRecord& record, KeptVisit& kept,
                                             JobControl& control) -> Result<void> {
        // Asked before the transaction begins: once it runs, it ends, whole or not at all.
        if (control.cancelled.load()) return Error{Errc::Cancelled, "nothing was stored"};
        RELIEVO_ASSERT(session_.products().model.has_value());
        RELIEVO_TRY_ASSIGN(kept, records.keep(record, *session_.products().model));
        return {};
      }),
      look_up_([&records = parts.records](const RecordQuestion& question, RecordAnswer& answer,
                                          JobControl&) -> Result<void> {
        // Whom the records cannot answer for is somebody new; a code they cannot answer for is none.
        answer.known = question.code.empty() ? ui::Known::Nobody : ui::Known::NoSuchCode;
        RELIEVO_TRY_ASSIGN(answer, records.look_up(question));
        return {};
      }),
      capture_(reports_, "capture"),
      worker_(reports_, "worker"),
      keeper_(reports_, "keeper") {
  const int most = std::ranges::max(ui::info_of(ui::Setting::Attempts).values);
  records_.reserve(std::size_t(most) * (kStages.size() + SidePairs::kPoses + 1));
  has_judge_ = parts.judge != nullptr;
  start(capture_, open_cameras_);
}

Appliance::~Appliance() { stop_job(); }

void Appliance::ask(ui::Intent intent) {
  if (intent == ui::Intent::StillHere) return machine_.renew(device_.clock().now());
  if (intent == ui::Intent::Enough) return turn_.finish();
  handle(event_of(intent));
  if (!session_.is_open()) record_ = {};
}

void Appliance::ask_records(RecordQuestion question) {
  if (looks_up_) stop_job();  // of a visitor who has gone
  answer_ = {question.code.empty() ? ui::Known::Nobody : ui::Known::NoSuchCode};
  if (machine_.state() != State::Idle || running_ != nullptr) return;
  look_up_.give(std::move(question));
  answer_ = {ui::Known::Asking};
  looks_up_ = true;
  start_on_keeper(look_up_);
}

// The job has ended; what it was asked goes, too.
void Appliance::heard_answer() {
  looks_up_ = false;
  const RecordAnswer answer = look_up_.take();
  look_up_.give({});
  if (!std::exchange(drops_answer_, false)) answer_ = answer;
}

void Appliance::step(std::chrono::milliseconds wait) {
  if (const auto report = reports_.take_for(wait)) heard(*report);
  if (awaits_keeper_ != nullptr && !keeper_.busy())
    job_ = start_on(keeper_, *std::exchange(awaits_keeper_, nullptr));
  const hal::Instant now = device_.clock().now();
  if (machine_.limit_reached(now)) await_commit();
  if (const auto change = machine_.tick(now)) {
    if (change->to == State::Idle || change->to == State::Fault) {
      problem_ = Error{Errc::Timeout, "took longer than its limit: try again"}.at(name_of(change->from));
    }
    entered(*change);
  }
  look_at_progress();
  device_.watchdog().kick();
}

void Appliance::handle(Event event) {
  if (const auto change = machine_.handle(event, device_.clock().now())) entered(*change);
}

void Appliance::note(const pipeline::DriftJudgement& drift) {
  drift_ = drift;
  if (drift.verdict == pipeline::DriftVerdict::Ok) calibration_note_.clear();
  if (drift.verdict == pipeline::DriftVerdict::Refuse) ++moved_in_a_row_;
  else if (drift.verdict != pipeline::DriftVerdict::Unknown) moved_in_a_row_ = 0;
  if (drift.verdict == pipeline::DriftVerdict::Warn || drift.verdict == pipeline::DriftVerdict::Refuse)
    calibration_note_ = pipeline::sentence(drift);
}

void Appliance::calibrated_anew() {
  drift_.reset();
  calibration_note_.clear();
  moved_in_a_row_ = 0;
  if (problem_ && problem_->code == Errc::NotCalibrated) problem_.reset();
}

Result<void> Appliance::start_side_job(JobLane lane, Job& job) {
  if (lane == JobLane::Keeper && awaits_keeper_ != nullptr)
    return Error{Errc::InvalidState, "a visitor waits for this thread"};
  RELIEVO_TRY_ASSIGN(side_jobs_[std::size_t(lane)], thread_at(lane).start(job));
  return {};
}

void Appliance::end_side_job(JobLane lane) {
  if (side_jobs_[std::size_t(lane)] == 0) return;
  thread_at(lane).cancel();
  thread_at(lane).wait_until_idle();
  side_jobs_[std::size_t(lane)] = 0;
}

// What a job could not do: is the machine broken, or can another try or an advice help?
void Appliance::failed(const Error& error) {
  problem_ = error;
  const State state = machine_.state();
  const bool advise = attended_ && state != State::Position && state != State::Store && session_.is_open();
  handle(is_fault(error.code) || state == State::SelfTest ? Event::Failed
         : advise                                         ? Event::AdviceGiven
                                                          : Event::StageFailed);
}

// Done: no side comes any more; where the cameras' thread has not said so yet, Fuse is left as soon as it is
// entered. Failed: the frontal picture did.
void Appliance::heard_head(const JobReport& report) {
  head_job_ = 0;
  for (const StageRecord& one : head_.records()) keep_record(one);
  if (session_.products().drift) note(*session_.products().drift);
  if (report.error) return failed(*report.error);
  if (machine_.state() == State::Fuse) handle(Event::StageDone);
}

void Appliance::heard(const JobReport& report) {
  if (const auto side = std::ranges::find(side_jobs_, report.job); side != side_jobs_.end()) {
    *side = 0;
    if (side_listener_) side_listener_(static_cast<JobLane>(side - side_jobs_.begin()), report.error);
    return;
  }
  if (report.job == head_job_) {
    if (running_ == &worker_) running_ = nullptr, job_ = 0;
    return heard_head(report);
  }
  if (report.job != job_) return;  // of a state that was left
  running_ = nullptr;
  job_ = 0;
  if (looks_up_) {
    heard_answer();
    if (!report.error) return;
    problem_ = report.error;
    if (is_fault(report.error->code)) handle(Event::Failed);
    return;
  }
  const State state = machine_.state();
  if (stage_.record().name == name_of(state)) keep_record(stage_.record());
  if (state == State::Match && session_.products().drift) note(*session_.products().drift);
  // What goes wrong while the sides are taken costs them, never the face.
  const bool sides_end = state == State::Turn && report.error;
  if (report.error && !sides_end) return failed(*report.error);
  if (state == State::Store) kept_ = keep_.take();
  if (state == State::SelfTest) problem_.reset();  // whatever led to it is over
  const bool turns = attended_ && asks_for_sides_ && has_judge_ && session_.has_sides();
  handle(state == State::SelfTest  ? Event::Passed
         : state != State::Capture ? Event::StageDone
         : turns                   ? Event::TurnAsked
                                   : Event::Triggered);
}

JobId Appliance::start_on(JobThread& thread, Job& job) {
  if (thread.busy()) {  // with work of the staff's pages: a visitor comes first, its report still comes
    thread.cancel();
    thread.wait_until_idle();
  }
  const Result<JobId> id = thread.start(job);
  RELIEVO_ASSERT(id.has_value());  // entered() has stopped the job before
  return *id;
}

void Appliance::start(JobThread& thread, Job& job) {
  job_ = start_on(thread, job);
  running_ = &thread;
}

void Appliance::start_on_keeper(Job& job) {
  running_ = &keeper_;
  awaits_keeper_ = &job;
  if (keeper_.busy()) keeper_.cancel();
  else job_ = start_on(keeper_, *std::exchange(awaits_keeper_, nullptr));
}

void Appliance::stop_job() {
  if (running_ == nullptr) return;
  if (std::exchange(awaits_keeper_, nullptr) == nullptr) {
    running_->cancel();
    running_->wait_until_idle();
  }
  running_ = nullptr;
  job_ = 0;
  if (looks_up_) heard_answer();
}

void Appliance::stop_head() {
  if (head_job_ == 0) return;
  worker_.cancel();
  worker_.wait_until_idle();
  head_job_ = 0;
}

// For another try what the one before made goes; who is photographed still sees themselves. False when no
// session opens; the machine has then moved on.
bool Appliance::open_session(const Transition& change) {
  if (change.from != State::Idle) {
    session_.retake(change.from == State::Position && change.to == State::Capture);
    return true;
  }
  attempt_ = 0;
  problem_.reset();
  drift_.reset();
  records_.clear();
  const Result<void> opened = session_.open(record_.name.view());
  if (opened) return true;
  problem_ = opened.error();
  handle(Event::Cancel);
  return false;
}

// The live picture. False when there is none to show; the machine has then moved on.
bool Appliance::enter_position(const Transition& change) {
  attended_ = true;
  if (!open_session(change)) return false;
  if (change.from == State::Review) attempt_ = 0, problem_.reset();
  if (attempt_ >= most_attempts_) {
    handle(Event::Cancel);
    return false;
  }
  start(capture_, pose_);
  return true;
}

// False when there is no capture to begin; the machine has then moved on.
bool Appliance::enter_capture(const Transition& change) {
  if (change.from == State::Idle) attended_ = false;
  if (!open_session(change)) return false;
  if (change.event == Event::Retake) attempt_ = 0;
  if (++attempt_ > most_attempts_) {
    handle(Event::Cancel);
    return false;
  }
  start(capture_, grab_);
  return true;
}

// Two jobs at once: the worker has the arenas, the cameras' thread memory of its own.
void Appliance::enter_turn() {
  making_.begin(true);
  session_.sides().begin();
  turn_.begin_with(*session_.products().frame);
  head_job_ = start_on(worker_, head_);
  start(capture_, turn_);
}

// The technician's test capture lies in it, and the staff's pages may be at work on that.
void Appliance::close_session() {
  for (JobThread* thread : {&capture_, &worker_}) {
    if (!thread->busy()) continue;
    thread->cancel();
    thread->wait_until_idle();
  }
  if (session_.is_open()) record_ = {};
  keep_.give({});
  (void)keep_.take();
  session_.close();
}

void Appliance::entered(const Transition& change) {
  stop_job();
  if (change.to != State::Fuse) stop_head();
  switch (change.to) {
    case State::SelfTest: start(capture_, open_cameras_); break;
    case State::Position:
      if (!enter_position(change)) return;
      break;
    case State::Capture:
      if (!enter_capture(change)) return;
      break;
    case State::Turn: enter_turn(); break;
    case State::Fuse:  // the head's job runs since Turn
      if (head_job_ == 0) return handle(Event::StageDone);
      running_ = &worker_;
      job_ = head_job_;
      break;
    case State::Match:
      if (change.from == State::Capture) session_.live().wipe();  // no page shows the mirror any more
      [[fallthrough]];
    case State::Reconstruct:
    case State::Mesh:
    case State::Texture:
    case State::Assemble:
      stage_.choose(change.to);
      start(worker_, stage_);
      break;
    case State::Store:
      problem_.reset();
      record_.stages = records_;
      record_.drift = drift_;
      keep_.give(record_);
      start_on_keeper(keep_);
      break;
    case State::Idle:
    case State::Fault: close_session(); break;
    case State::Review:
      if (change.from == State::Assemble || change.from == State::Fuse)
        problem_.reset();  // an attempt before it failed; this one did not
      break;
    case State::Calibrate:  // what they were entered for runs beside, as a side task of the staff's page
    case State::Export:
    case State::Staff:
    case State::Count: break;
  }
  if (listener_) listener_(change);
}

void Appliance::look_at_progress() {
  const hal::Instant now = device_.clock().now();
  const State state = machine_.state();
  if (is_stage(state)) making_.works_on(number_of(state), now);
  else if (state == State::Turn || state == State::Fuse) making_.works_on(head_.parts_done(), now);
  else if (state == State::Review || state == State::Store) making_.done();
  else making_.begin();
}

// What has begun to be stored is stored whole or not at all: the visitor is told which, whatever would end
// the state.
void Appliance::await_commit() {
  if (machine_.state() != State::Store || job_ == 0) return;
  keeper_.cancel();
  keeper_.wait_until_idle();
  while (const auto report = reports_.take_for(std::chrono::milliseconds(0))) heard(*report);
}

void Appliance::give_up(const Error& error) {
  await_commit();
  if (!session_.is_open()) return;  // it was stored
  problem_ = error;
  handle(Event::Failed);
}

}  // namespace relievo::firmware
