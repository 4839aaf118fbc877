// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/take_home.h"

#include "firmware/base/budget.h"

namespace relievo::firmware {

void TakeHome::look(bool visited) {
  const bool there = parts_.media.current().has_value();
  if (there && !there_) {
    // The staff's export, which may go on after they have left, lets its stick go and takes it up again.
    ours_ = visited && !parts_.media.is_taken_up();
    writing_.reset();  // how it went with another stick is no news
    given_up_ = false;
  }
  there_ = there;
  ours_ = ours_ && visited && there;
}

void TakeHome::follow(ui::ViewState& view, bool visited) {
  ui::TakeHomeView& home = view.take_home;
  // A visit that ends while its copy is still being stopped leaves its stick to nobody.
  ours_ = ours_ && visited;
  const bool left = view.receipt.empty();
  if (writes()) {
    if (left || view.now - begun_ > budget::kTakeHomeLimit) {
      given_up_ = true;
      stop();
    }
  } else {
    if (left) {
      writing_.reset();
      given_up_ = false;
    }
    if (!view.settings.is_on(ui::Setting::TakeHome)) {
      ours_ = false;
      there_ = true;
      return;
    }
    // The staff's export may hold its stick for long; what is there afterwards is no visitor's.
    if (!visited && parts_.side_tasks.busy(JobLane::Keeper)) {
      there_ = true;
    } else if (wrote_ || view.now - looked_ >= budget::kStickLook) {
      looked_ = view.now;
      look(visited);
    }
  }
  wrote_ = writes();
  if (left) return;
  using ui::Taking;
  if (writes() && !given_up_) {
    home.taking = Taking::Busy;
    home.progress = parts_.side_tasks.progress(JobLane::Keeper);
    return;
  }
  home.taking = writes() || !there_ ? Taking::NoStick : ours_ ? Taking::Ready : Taking::NotOurs;
  if (given_up_) home.outcome = ui::Outcome::Failed;
  else if (writing_ != nullptr) home.outcome = writing_->outcome;
}

void TakeHome::take(storage::EnrolmentId enrolment, const ui::Settings& settings) {
  if (writes() || !ours_) return;
  writing_ = std::make_shared<Writing>();
  given_up_ = false;
  begun_ = parts_.clock.now();
  const FurtherModels further{.watertight = settings.is_on(ui::Setting::Solids)};
  task_ = parts_.side_tasks.send(
      JobLane::Keeper,
      [parts = parts_, writing = writing_, enrolment, further](JobControl& control) -> Result<void> {
        RELIEVO_TRY_ASSIGN(const storage::Enrolment stored, parts.store.enrolment(enrolment));
        return export_records(parts.store, parts.clock, parts.media, {stored.subject}, further, control,
                              writing->trace);
      },
      [&log = parts_.log, writing = writing_](const std::optional<Error>& error) {
        writing->ended = true;
        // A stick that was there for the touch and is not for the keeper was pulled out.
        writing->outcome = !error                              ? ui::Outcome::Done
                           : error->code == Errc::MediaMissing ? ui::Outcome::StickGone
                                                               : outcome_of_export(*error, writing->trace);
        if (writing->trace.whole > 0) log.say(ui::LogEvent::TakenHome);
        if (error && error->code != Errc::Cancelled) log.fault(*error);
      },
      SideTasks::Whose::Device);
}

// It may still wait for the keeper behind others' work, which goes on.
void TakeHome::stop() {
  if (writes()) parts_.side_tasks.stop(task_);
}

}  // namespace relievo::firmware
