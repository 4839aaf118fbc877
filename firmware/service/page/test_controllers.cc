// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/page/test_controllers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "firmware/records/disk_room.h"
#include "firmware/report/report.h"
#include "firmware/service/page/log_lines.h"

namespace relievo::firmware {
namespace {

using ui::Check;
using ui::CheckState;

constexpr std::chrono::milliseconds kBetweenPulses{100};

// One pair, looked at by nobody and wiped; beside the last test capture, which stays.
Result<pipeline::StereoFrame> one_pair(PageServices& services, JobControl& control) {
  StereoGrabber& grabber = services.appliance.grabber();
  RELIEVO_TRY(grabber.start(services.device.preferred_mode()));
  StereoSlot& slot = services.appliance.session().free_slot();
  const auto pair = grabber.grab(slot, control.cancelled);
  slot.wipe();
  return pair;
}

}  // namespace

void SelfTestController::opened() {
  ++visit_;
  view_ = {};
}

void SelfTestController::begin(Check check, JobLane lane, SideTasks::Work work) {
  const auto at = static_cast<std::size_t>(check);
  view_.states[at] = CheckState::Running;
  ++running_;
  services().side_tasks.send(lane, std::move(work),
                             [this, at, visit = visit_](const std::optional<Error>& error) {
                               --running_;
                               if (error) services().log.fault(*error);
                               if (visit != visit_) return;
                               view_.states[at] = error ? CheckState::Bad : CheckState::Good;
                               view_.problems[at] = error ? ui::fault_of(*error) : ui::Fault{};
                             });
}

void SelfTestController::ask(const ui::StaffRequest& request) {
  if (request.as<ui::BeginSelfTest>() == nullptr || running_ > 0) return;
  view_ = {};
  PageServices& t = services();
  t.log.say(ui::LogEvent::SelfTestBegun);
  begin(Check::Memory, JobLane::Keeper, [](JobControl&) -> Result<void> {
    if (peak_rss_bytes() > budget::kApplianceBytes)
      return Error{Errc::OutOfMemory,
                   "the program has used more memory than was planned: see the page of health"};
    return {};
  });
  begin(Check::Store, JobLane::Keeper, [&t](JobControl&) { return t.store.check(); });
  // The one that is measured with, which may be a file's or the simulated rig's and so not the store's active
  // one.
  begin(Check::Calibration, JobLane::Keeper, [&t, revision = t.calibration](JobControl&) -> Result<void> {
    RELIEVO_TRY(revision == 0 ? t.store.active_calibration() : t.store.calibration(revision));
    return {};
  });
  begin(Check::Disk, JobLane::Keeper,
        [&t, least = t.settings.now().of(ui::Setting::LeastRoomMib)](JobControl&) {
          return disk_has_room(t.folder, least);
        });
  begin(Check::Cameras, JobLane::Capture, [&t](JobControl& control) -> Result<void> {
    RELIEVO_TRY(one_pair(t, control));
    return {};
  });
}

void SelfTestController::show(ui::ServiceView& view) {
  view.work.running = running_ > 0;
  view.self_test = &view_;
}

void TriggerController::opened() {
  ++visit_;
  view_ = {};
}

void TriggerController::closed() {
  ++visit_;
  if (running_) services().side_tasks.stop(JobLane::Capture);
}

void TriggerController::ask(const ui::StaffRequest& request) {
  if (request.as<ui::BeginTriggerTest>() == nullptr || running_) return;
  running_ = true;
  view_ = {};
  const auto seen = std::make_shared<ui::TriggerView>();
  PageServices& t = services();
  t.side_tasks.send(
      JobLane::Capture,
      [&t, seen](JobControl& control) -> Result<void> {
        const GrabCounts before = t.appliance.grabber().counts();
        std::optional<Error> last;
        for (; seen->pulses < kPulses && !control.cancelled.load(); ++seen->pulses) {
          const hal::Instant asked = t.device.clock().now();
          const auto pair = one_pair(t, control);
          const std::chrono::duration<double, std::milli> took = t.device.clock().now() - asked;
          if (pair) {
            ++seen->pairs;
            seen->delay_ms = std::max(seen->delay_ms, took.count());
            seen->apart_ms = std::max(seen->apart_ms, std::abs(static_cast<double>(pair->skew_ns)) * 1e-6);
          } else {
            last = pair.error();
          }
          control.progress.done.store(static_cast<float>(seen->pulses + 1) / kPulses);
          std::this_thread::sleep_for(kBetweenPulses);
        }
        const GrabCounts& after = t.appliance.grabber().counts();
        seen->late = after.left.late - before.left.late + after.right.late - before.right.late;
        seen->lost = after.left.lost - before.left.lost + after.right.lost - before.right.lost;
        seen->damaged = after.left.damaged - before.left.damaged + after.right.damaged - before.right.damaged;
        return last ? Result<void>(*last) : Result<void>();
      },
      [this, seen, visit = visit_](const std::optional<Error>& error) {
        running_ = false;
        if (error) services().log.fault(*error);
        if (visit != visit_) return;
        view_ = *seen;
        view_.ended = true;
      });
}

void TriggerController::show(ui::ServiceView& view) {
  view.work.running = running_;
  view.trigger = &view_;
}

std::vector<LogEntry> LogController::wanted() const {
  std::vector<LogEntry> lines = services().log.entries();
  std::reverse(lines.begin(), lines.end());
  if (walk_.filter() != 0) std::erase_if(lines, [](const LogEntry& line) { return !line.fault; });
  return lines;
}

void LogController::ask(const ui::StaffRequest& request) {
  const auto* asked = request.as<ui::ListRequest>();
  if (asked == nullptr || walk_.ask(*asked) != ListWalk::Ask::Labels) return;
  const std::vector<LogEntry> lines = wanted();
  for (std::size_t i = 0; i < walk_.stretches(); ++i) {
    const auto top = static_cast<std::size_t>(walk_.top_row(i));
    walk_.set_label(i, top < lines.size() ? lines[top].at : std::string());
  }
}

void LogController::show(ui::ServiceView& view) {
  lines_ = wanted();
  walk_.set_rows(static_cast<std::int64_t>(lines_.size()));
  lines_.erase(lines_.begin() + walk_.end_row(), lines_.end());
  lines_.erase(lines_.begin(), lines_.begin() + walk_.first_row());
  show_lines(lines_, shown_);
  view_ = {shown_, walk_.view()};
  view.log = &view_;
}

}  // namespace relievo::firmware
