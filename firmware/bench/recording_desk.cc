// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/bench/recording_desk.h"

#include <ctime>
#include <utility>

namespace relievo::firmware {
namespace {

// A name every file system of a stick takes: 2026-03-12_09-14-07, UTC.
std::string name_at(std::chrono::system_clock::time_point when) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(when);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char name[32];
  std::strftime(name, sizeof name, "%Y-%m-%d_%H-%M-%S", &parts);
  return name;
}

}  // namespace

void RecordingDesk::record(const pipeline::StereoFrame& frame, hal::RecordedPair as_taken) {
  if (running_) return;
  as_taken.left_ns = 0;
  as_taken.right_ns = frame.skew_ns;
  const auto copy = std::make_shared<const CaptureCopy>(frame, std::move(as_taken));
  const auto trace = std::make_shared<ExportTrace>();
  const std::string name = name_at(board_.clock().wall_now());
  running_ = true;
  outcome_ = ui::Outcome::None;
  where_.clear();
  errands_.send(
      JobPlace::Keeper, [this, copy, trace, name](JobControl& control) { return record_capture(copy->pair(), name, board_.media(), control, *trace); },
      [this, trace, name, visit = visit_](const std::optional<Error>& error) {
        if (visit != visit_) return;
        running_ = false;
        outcome_ = error ? outcome_of_export(*error, *trace) : ui::Outcome::Done;
        if (!error || outcome_ == ui::Outcome::StickHeld) where_ = std::string(kCapturesFolder) + "/" + name;
      });
}

void RecordingDesk::stop() {
  if (running_) errands_.stop(JobPlace::Keeper);
}

void RecordingDesk::capture_gone() {
  outcome_ = ui::Outcome::None;
  where_.clear();
}

void RecordingDesk::forget() {
  ++visit_;
  running_ = false;
  capture_gone();
}

ui::BenchRecording RecordingDesk::view() const {
  return {running_, running_ ? errands_.progress(JobPlace::Keeper) : 0, outcome_, where_};
}

}  // namespace relievo::firmware
