// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/staff/desk.h"

#include <algorithm>
#include <utility>

#include "firmware/base/wall_time.h"
#include "firmware/staff/bench_desk.h"
#include "firmware/staff/desk_pages.h"
#include "hal/base/assert.h"

namespace relievo::firmware {
namespace {

using ui::StaffPage;
using ui::StaffRole;

constexpr std::chrono::seconds kWarning{15};  // before somebody is signed out

bool is_service(State state) {
  return state == State::Staff || state == State::Calibrate || state == State::Export;
}

}  // namespace

ui::Outcome outcome_of(const Error& error) {
  switch (error.code) {
    case Errc::Cancelled:
      return ui::Outcome::Cancelled;
    case Errc::MediaMissing:
      return ui::Outcome::NoStick;
    case Errc::MediaFull:
      return ui::Outcome::StickFull;
    case Errc::Disconnected:
      return ui::Outcome::StickGone;
    case Errc::NotFound:
      return ui::Outcome::NotFound;
    case Errc::InvalidInput:
    case Errc::InvalidState:
    case Errc::Unsupported:
      return ui::Outcome::Refused;
    case Errc::Timeout:
    case Errc::NotCalibrated:
    case Errc::NoFace:
    case Errc::TooFewMatches:
    case Errc::PoorGeometry:
    case Errc::LibraryFailed:
    case Errc::OutOfMemory:
    case Errc::StoreCorrupt:
    case Errc::StoreNewer:
    case Errc::IoFailed:
      break;
  }
  return ui::Outcome::Failed;
}

Desk::Desk(Parts parts)
    : parts_(std::move(parts)),
      log_(parts_.device.clock(), parts_.folder / kLogFile),
      errands_(parts_.appliance),
      settings_(parts_.store, errands_, log_, parts_.device.clock()),
      retention_(parts_.store, errands_, log_, parts_.device.clock()),
      touch_(parts_.store, errands_, log_, parts_.device.clock()),
      consent_(parts_.folder, parts_.device.media(), errands_, log_),
      tools_{parts_.appliance, parts_.device, parts_.store, errands_, log_,          statistics_,
             settings_,        retention_,    touch_,       consent_, parts_.folder, parts_.calibration},
      door_({parts_.store, parts_.device.clock(), errands_, log_, parts_.set_clock, consent_,
             parts_.device.is_live()}) {
  fill_desk_pages(tools_, pages_);
  parts_.appliance.on_change([this](const Change& change) { noted(change); });
}

Desk::~Desk() {
  parts_.appliance.on_change({});
  close_page();
  for (const JobPlace place : {JobPlace::Capture, JobPlace::Worker, JobPlace::Keeper})
    parts_.appliance.end_side_job(place);  // it uses what is below
}

Result<std::unique_ptr<Desk>> Desk::open(Parts parts) {
  std::unique_ptr<Desk> desk(new Desk(std::move(parts)));
  RELIEVO_TRY(desk->door_.look());
  RELIEVO_TRY(desk->settings_.look());
  RELIEVO_TRY(desk->touch_.look());
  RELIEVO_TRY(desk->consent_.look());
  const Result<std::string> kept = desk->parts_.store.setting(kStatisticsSetting);
  if (!kept && kept.error().code != Errc::NotFound) return kept.error();
  if (!kept || !desk->statistics_.read(*kept))
    desk->statistics_.begin(
        text_of(std::chrono::floor<std::chrono::milliseconds>(desk->parts_.device.clock().wall_now()))
            .substr(0, 10));
  desk->log_.say(ui::LogEvent::Started);
  return desk;
}

void Desk::set_bench(std::unique_ptr<Bench> bench) {
  bench_ = std::move(bench);
  fill_bench_pages(tools_, *bench_, pages_);
}

void Desk::noted(const Change& change) {
  std::chrono::nanoseconds total{0};
  for (const StageRecord& record : parts_.appliance.records()) total += record.took;
  const auto& problem = parts_.appliance.problem();
  const bool wrong = change.event == Event::Failed || change.event == Event::StageFailed ||
                     change.event == Event::AdviceGiven || change.event == Event::Timeout;
  statistics_.noted(change, problem ? &*problem : nullptr, total);
  if (wrong && problem) log_.fault(*problem);
}

bool Desk::inside() const { return role_ != StaffRole::None; }

void Desk::touched() { last_touch_ = parts_.device.clock().now(); }

void Desk::ask(const ui::StaffWish& wish) {
  touched();
  if (wish.verb == ui::kPageLeft) return leave();
  const bool door =
      wish.page == StaffPage::Pin || wish.page == StaffPage::FirstStart || wish.page == StaffPage::Pins;
  if (!inside() && wish.page != StaffPage::Pin && wish.page != StaffPage::FirstStart) return;
  if (wish.verb == ui::kPageOpened) {
    close_page();
    if (door) door_.opened(wish.page);
    page_ = may_open(role_, wish.page) ? pages_[static_cast<std::size_t>(wish.page)].get() : nullptr;
    if (page_ != nullptr) page_->opened();
    return;
  }
  if (door) return door_.ask(wish, role_);
  if (page_ != nullptr && page_ == pages_[static_cast<std::size_t>(wish.page)].get()) page_->ask(wish);
}

void Desk::close_page() {
  if (page_ != nullptr) page_->closed();
  page_ = nullptr;
}

// The machine lets somebody in from Idle or Fault only; from a self-test as soon as it has ended.
void Desk::let_in() {
  if (const StaffRole entered = door_.take_entered(); entered != StaffRole::None) waiting_ = entered;
  if (waiting_ == StaffRole::None) return;
  parts_.appliance.ask(ui::Intent::OpenStaff);
  if (parts_.appliance.state() != State::Staff) return;
  role_ = tools_.role = std::exchange(waiting_, StaffRole::None);
  touched();
}

void Desk::leave() {
  waiting_ = StaffRole::None;
  door_.forget();
  if (!inside()) return;
  if (parts_.appliance.state() != State::Staff) parts_.appliance.ask(ui::Intent::Cancel);
  parts_.appliance.ask(ui::Intent::LeaveStaff);
}

int Desk::seconds_left() const {
  const auto left = std::chrono::ceil<std::chrono::seconds>(
      last_touch_ + std::chrono::seconds(settings().of(ui::Setting::StaffPatienceS)) -
      parts_.device.clock().now());
  return static_cast<int>(std::max<std::int64_t>(0, left.count()));
}

void Desk::turn() {
  errands_.turn();
  touch_.turn();
  let_in();
  const State state = parts_.appliance.state();
  // A long export or calibration is somebody's, even if nobody touches the screen.
  if (state == State::Calibrate || state == State::Export) touched();
  if (inside() && state == State::Staff && seconds_left() == 0) leave();
  if (inside() && !is_service(parts_.appliance.state())) {
    close_page();
    errands_.cancel();
    door_.forget();
    role_ = tools_.role = StaffRole::None;
    log_.say(ui::LogEvent::SignedOut);
  }
  if (bench_ != nullptr) bench_->turn();
  if (state == State::Idle || state == State::Staff) save_what_changed();
  if (state == State::Idle) retention_.turn(settings());
}

void Desk::save_what_changed() {
  if (errands_.busy(JobPlace::Keeper)) return;
  const bool counted = statistics_.changes() != saved_statistics_;
  if (!counted && !log_.unsaved()) return;
  saved_statistics_ = statistics_.changes();
  errands_.send(
      JobPlace::Keeper,
      [this, text = counted ? statistics_.text() : std::string()](JobControl&) -> Result<void> {
        RELIEVO_TRY(log_.save());
        return text.empty() ? Result<void>() : parts_.store.set_setting(kStatisticsSetting, text);
      },
      [](const std::optional<Error>&) {},
      Errands::Whose::Device);  // a full disk must not fill the log with its own complaint
}

const ui::ServiceView& Desk::view() {
  view_ = {};
  view_.role = role_;
  if (inside() && parts_.appliance.state() == State::Staff && seconds_left() <= kWarning.count())
    view_.leaves_in_s = seconds_left();
  door_.show(view_.access);
  consent_.show(consent_view_);
  view_.consent = &consent_view_;
  if (page_ != nullptr) page_->show(view_);
  return view_;
}

}  // namespace relievo::firmware
