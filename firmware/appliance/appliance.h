// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Appliance: the state machine with everything it sets in motion. It owns the machine, the session
// and the three threads; device, stages and store are handed in. One step() is one turn of the main
// loop: it hears one report, looks at the clock, kicks the watchdog.
//
//   ask(Intent), reports of the threads, time --> Machine --> what entering the new state starts
//
// A state is left only when its job has stopped; a session is closed on the way to Idle and Fault.
// Thread: main. Errors: none are returned; problem() holds the last one, for screen and command.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/machine/machine.h"
#include "firmware/session/session.h"
#include "firmware/work/jobs.h"
#include "hal/device.h"
#include "ui/view/action.h"
#include "ui/view/view_state.h"

namespace relievo::firmware {

// The three threads, for work that belongs to no visitor's state.
enum class JobLane : std::uint8_t { Capture, Worker, Keeper };
inline constexpr std::size_t kJobLanes = 3;

class Appliance {
 public:
  struct Parts {
    hal::Device& device;
    StageRunner& stages;
    const BootMemory& memory;
    ThreadPool& pool;
    VisitRecords& records;
    LiveJudge* judge = nullptr;  // advice for a person at the screen; without one the picture alone is shown
  };
  explicit Appliance(Parts parts);
  ~Appliance();
  Appliance& operator=(Appliance&&) = delete;

  // What the next visit is stored as. It is remembered no longer than that visit's session; without one it
  // goes with the next intent.
  void expect(VisitRecord record) { record_ = std::move(record); }
  // Of the visit that was stored last, until it is forgotten.
  const KeptVisit& kept() const { return kept_; }
  void forget_kept() { kept_ = {}; }
  // Asks the records, while nobody's session is open; Asking until they have answered.
  void ask_records(RecordQuestion question);
  const RecordAnswer& answer() const { return answer_; }
  void forget_answer() {
    answer_ = {};
    drops_answer_ = looks_up_;
  }
  void ask(ui::Intent intent);
  // Ends a visit that the main thread cannot go on with.
  void give_up(const Error& error);
  // Waits at most `wait` for something to happen, and deals with it.
  void step(std::chrono::milliseconds wait);

  State state() const { return machine_.state(); }
  // 0 to 1 of the way from the photograph to the portrait; it falls for a new photograph alone.
  float progress() const { return making_.share(); }
  int attempt() const { return attempt_; }
  // Refused captures, until a person is asked to come again.
  void set_attempts(int most) { most_attempts_ = most; }
  // Does a person at the screen come to Turn after the frontal picture? Never without a judge and the memory.
  void ask_for_sides(bool asks) { asks_for_sides_ = asks; }
  // Of the job that runs while the head turns (HeadJob).
  std::size_t parts_done() const { return head_.parts_done(); }
  const std::optional<Error>& problem() const { return problem_; }
  // Of the last face that was matched: have the cameras moved?
  const std::optional<pipeline::DriftJudgement>& drift() const { return drift_; }
  // How many faces on end have said that they have moved too far to be measured with. Kept over visits.
  int moved_in_a_row() const { return moved_in_a_row_; }
  // What an earlier run of the device knew of the calibration in use; before anything runs.
  void remember_moved(int faces, std::string note) {
    moved_in_a_row_ = faces, calibration_note_ = std::move(note);
  }
  // Another calibration is in use: what was said against the one before counts no more.
  void calibrated_anew();
  // For the technician: what the last face that could tell said against the calibration, in English;
  // else empty.
  std::string_view calibration_note() const { return calibration_note_; }
  // Is a camera away, and being tried again?
  CameraWatch cameras() const { return grabber_.watch(); }
  const EnrolmentSession& session() const { return session_; }
  // For the live picture, which is handed over on reading.
  LiveFeed& live() { return session_.live(); }
  // Of the present or last session; kept until the next begins.
  const std::vector<StageRecord>& records() const { return records_; }
  // Work of the staff's pages, beside the states' own (firmware/service/side_tasks.h). InvalidState: the
  // thread is busy, or a visitor's question waits for it. A state that needs the thread stops such work and
  // waits for it to end; the keeper's is waited for between the turns, since a stick may hold it for long.
  Result<void> start_side_job(JobLane lane, Job& job);
  void cancel_side_job(JobLane lane) {
    if (side_jobs_[std::size_t(lane)] != 0) thread_at(lane).cancel();
  }
  void end_side_job(JobLane lane);  // waits until it has stopped; it is not reported any more
  float side_progress(JobLane lane) {
    return side_jobs_[std::size_t(lane)] == 0 ? 0 : thread_at(lane).progress();
  }
  void on_side_report(std::function<void(JobLane, const std::optional<Error>&)> listener) {
    side_listener_ = std::move(listener);
  }
  // What Calibrate or Export was entered for has ended: back to Staff.
  void end_service_state(bool done) { handle(done ? Event::StageDone : Event::StageFailed); }
  // For work on the capture thread.
  StereoGrabber& grabber() { return grabber_; }
  EnrolmentSession& session() { return session_; }
  // Called after every change of state, when what it starts has started.
  void on_change(std::function<void(const Transition&)> listener) { listener_ = std::move(listener); }

 private:
  void handle(Event event);
  void entered(const Transition& change);
  bool enter_position(const Transition& change);
  bool enter_capture(const Transition& change);
  bool open_session(const Transition& change);
  void enter_turn();
  void start(JobThread& thread, Job& job);
  void start_on_keeper(Job& job);
  JobId start_on(JobThread& thread, Job& job);
  void await_commit();
  void stop_job();
  void stop_head();
  JobThread& thread_at(JobLane lane) {
    return lane == JobLane::Capture ? capture_ : lane == JobLane::Worker ? worker_ : keeper_;
  }
  void heard(const JobReport& report);
  void heard_head(const JobReport& report);
  void failed(const Error& error);
  void close_session();
  void heard_answer();
  void look_at_progress();
  // A visitor may retake for ever: without more memory the eldest make room.
  void keep_record(const StageRecord& one) {
    if (records_.size() == records_.capacity()) records_.erase(records_.begin());
    records_.push_back(one);
  }
  void note(const pipeline::DriftJudgement& drift);

  hal::Device& device_;
  Machine machine_;
  EnrolmentSession session_;
  StereoGrabber grabber_;
  FunctionJob open_cameras_;
  PoseJob pose_;
  GrabJob grab_;
  TurnJob turn_;
  StageJob stage_;
  HeadJob head_;
  KeeperJob<VisitRecord, KeptVisit> keep_;           // puts a finished model away
  KeeperJob<RecordQuestion, RecordAnswer> look_up_;  // while nobody's session is open
  VisitRecord record_;
  KeptVisit kept_;
  RecordAnswer answer_;
  bool looks_up_ = false, drops_answer_ = false;
  PortraitProgress making_;
  int attempt_ = 0, most_attempts_ = budget::kCaptureAttempts;
  bool attended_ = false;  // a person is at the screen: advice instead of another try
  bool asks_for_sides_ = false, has_judge_ = false;
  std::optional<Error> problem_;
  std::optional<pipeline::DriftJudgement> drift_;
  std::string calibration_note_;
  int moved_in_a_row_ = 0;
  std::vector<StageRecord> records_;
  std::function<void(const Transition&)> listener_;
  JobThread* running_ = nullptr;  // the thread whose job belongs to the present state
  Job* awaits_keeper_ = nullptr;  // that job, until the keeper has stopped what it was at
  JobId job_ = 0;
  JobId head_job_ = 0;  // on the worker, from Turn until it reports in Fuse
  std::array<JobId, kJobLanes> side_jobs_{};
  std::function<void(JobLane, const std::optional<Error>&)> side_listener_;
  JobReports reports_;
  JobThread capture_;
  JobThread worker_;
  JobThread keeper_;
};

// What a screen sees of it at this moment. Valid until its next step().
ui::ViewState view_of(Appliance& appliance);

}  // namespace relievo::firmware
