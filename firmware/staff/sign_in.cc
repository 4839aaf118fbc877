// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/staff/sign_in.h"

#include <utility>

#include "firmware/base/wall_time.h"
#include "firmware/service/pin_hash.h"
#include "ui/view/staff_views.h"

namespace relievo::firmware {
namespace {

using ui::PinFault;
using ui::PinStep;
using ui::StaffPage;
using ui::StaffRole;

ui::LogEvent chosen_by(StaffRole role) {
  return role == StaffRole::Technician ? ui::LogEvent::TechnicianPinChosen : ui::LogEvent::OperatorPinChosen;
}

}  // namespace

SignIn::SignIn(Parts parts)
    : store_(parts.store),
      clock_(parts.clock),
      side_tasks_(parts.side_tasks),
      log_(parts.log),
      set_clock_(std::move(parts.set_clock)),
      consent_(parts.consent),
      access_(store_, clock_),
      demands_set_up_(parts.demands_set_up) {}

Result<void> SignIn::look() {
  RELIEVO_TRY_ASSIGN(set_up_, access_.is_set_up());
  RELIEVO_TRY_ASSIGN(forgotten_, access_.forgotten());
  RELIEVO_TRY_ASSIGN(const auto wait, access_.wait());
  wait_until_ = clock_.now() + wait;
  return {};
}

void SignIn::opened(StaffPage page) {
  forget();
  wrong_ = clock_right_ = clock_refused_ = consent_right_ = false;
  failed_.reset();
  if (page == StaffPage::FirstStart) consent_.opened();
  clock_moved_ = std::chrono::minutes(0);
  fault_ = PinFault::None;
  step_ = page == StaffPage::Pins             ? PinStep::Own
          : forgotten_ == StaffRole::Operator ? PinStep::Operator
                                              : PinStep::Technician;
}

void SignIn::forget() {
  ++visit_;
  entered_ = StaffRole::None;
  wipe_text(first_);
  wipe_text(technician_);
}

void SignIn::ask(const ui::StaffRequest& request, StaffRole role) {
  if (checking_) return;
  if (request.page == StaffPage::Pin && request.as<ui::CheckPin>() != nullptr) return check(request.text());
  const bool first = request.page == StaffPage::FirstStart && !set_up_;
  const bool clock = first || (request.page == StaffPage::Clock && role != StaffRole::None);
  if (request.as<ui::OfferPin>() != nullptr &&
      (first || (request.page == StaffPage::Pins && role != StaffRole::None)))
    return offer(request.text(), role);
  const auto* move = request.as<ui::MoveClock>();
  if (clock && move != nullptr) clock_moved_ += std::chrono::minutes(move->minutes);
  if (clock && request.as<ui::SetClock>() != nullptr) set_clock();
  if (!first) return;
  if (request.as<ui::TakeConsentText>() != nullptr) consent_.take();
  if (request.as<ui::ConfirmConsentText>() != nullptr) consent_right_ = true;
}

void SignIn::set_clock() {
  clock_right_ = true;
  if (clock_moved_.count() == 0 || clock_refused_) return;
  const Result<void> set = set_clock_
                               ? set_clock_(clock_.wall_now() + clock_moved_)
                               : Result<void>(Error{Errc::Unsupported, "this board's clock cannot be set"});
  clock_moved_ = std::chrono::minutes(0);
  clock_right_ = set.has_value();
  clock_refused_ = !set;
  if (set) log_.say(ui::LogEvent::ClockSet);
  else log_.fault(set.error());
}

void SignIn::check(std::string_view pin) {
  struct Tried {
    std::string pin;
    Attempt attempt;
  };
  const auto tried = std::make_shared<Tried>();
  tried->pin = pin;
  checking_ = true;
  side_tasks_.send(
      JobLane::Keeper,
      [this, tried](JobControl&) -> Result<void> {
        const auto answer = access_.attempt(tried->pin);
        wipe_text(tried->pin);
        RELIEVO_TRY_ASSIGN(tried->attempt, answer);
        return {};
      },
      [this, tried, visit = visit_](const std::optional<Error>& error) {
        checking_ = false;
        if (error) log_.fault(*error);
        wait_until_ = clock_.now() + tried->attempt.wait;
        if (tried->attempt.wrong) log_.say(ui::LogEvent::WrongPin);
        if (visit != visit_) return;  // whoever typed it has gone: the next one at the lock is another
        failed_ = error ? std::optional(error->code) : std::nullopt;
        wrong_ = tried->attempt.wrong;
        entered_ = error ? StaffRole::None : tried->attempt.role;
        if (entered_ == StaffRole::Technician) log_.say(ui::LogEvent::TechnicianSignedIn);
        if (entered_ == StaffRole::Operator) log_.say(ui::LogEvent::OperatorSignedIn);
      },
      SideTasks::Whose::Device);
}

// The first time a PIN is judged, the second time it is compared.
void SignIn::offer(std::string_view pin, StaffRole role) {
  fault_ = PinFault::None;
  failed_.reset();
  switch (step_) {
    case PinStep::Technician: return judge(std::string(pin), StaffRole::Technician, PinStep::TechnicianAgain);
    case PinStep::Operator:
      if (pin == technician_) {
        fault_ = PinFault::Taken;
        return;
      }
      return judge(std::string(pin), StaffRole::Operator, PinStep::OperatorAgain);
    case PinStep::Own: return judge(std::string(pin), role, PinStep::OwnAgain);
    case PinStep::TechnicianAgain:
    case PinStep::OperatorAgain:
    case PinStep::OwnAgain: return offered_again(pin, role);
    case PinStep::Done: return;
  }
}

void SignIn::offered_again(std::string_view pin, StaffRole role) {
  const PinStep before = step_ == PinStep::TechnicianAgain ? PinStep::Technician
                         : step_ == PinStep::OperatorAgain ? PinStep::Operator
                                                           : PinStep::Own;
  if (pin != first_) {
    fault_ = PinFault::Differ;
    step_ = before;
    return wipe_text(first_);
  }
  if (before == PinStep::Own)
    return save({std::exchange(first_, {}), {}}, before,
                [this, role](const Pins& pins) { return access_.set(role, pins.one); }, {chosen_by(role)});
  if (forgotten_ != StaffRole::None)
    return save(
        {std::exchange(first_, {}), {}}, before,
        [this, whose = forgotten_](const Pins& pins) { return access_.choose_again(whose, pins.one); },
        {chosen_by(forgotten_)});
  if (before == PinStep::Operator)
    return save({std::exchange(technician_, {}), std::exchange(first_, {})}, PinStep::Technician,
                [this](const Pins& pins) { return access_.set_up(pins.one, pins.clerk); },
                {ui::LogEvent::TechnicianPinChosen, ui::LogEvent::OperatorPinChosen});
  technician_ = std::exchange(first_, {});
  step_ = PinStep::Operator;
}

void SignIn::judge(std::string pin, StaffRole role, PinStep next) {
  const auto kept = std::make_shared<std::string>(std::move(pin));
  checking_ = true;
  side_tasks_.send(
      JobLane::Keeper, [this, kept, role](JobControl&) { return access_.check_new(role, *kept); },
      [this, kept, next, visit = visit_](const std::optional<Error>& error) {
        checking_ = false;
        if (error || visit != visit_) wipe_text(*kept);
        if (visit != visit_) return;
        if (error) return refuse(*error, step_);
        first_ = std::move(*kept);
        step_ = next;
      },
      SideTasks::Whose::Device);
}

void SignIn::refuse(const Error& error, PinStep again) {
  step_ = again;
  if (error.code == Errc::InvalidState) fault_ = PinFault::Taken;
  else if (error.code == Errc::InvalidInput) fault_ = PinFault::Simple;
  else failed_ = error.code, log_.fault(error);
}

// A PIN is kept by the keeper and known to nobody then. One of the two that was forgotten is chosen alone; a
// device that is new has both at once or none.
void SignIn::save(Pins pins, PinStep begins, std::function<Result<void>(const Pins&)> write,
                  std::vector<ui::LogEvent> said) {
  const auto kept = std::make_shared<Pins>(std::move(pins));
  checking_ = true;
  side_tasks_.send(
      JobLane::Keeper,
      [kept, write = std::move(write)](JobControl&) {
        const Result<void> saved = write(*kept);
        wipe_text(kept->one);
        wipe_text(kept->clerk);
        return saved;
      },
      [this, begins, said = std::move(said), visit = visit_](const std::optional<Error>& error) {
        checking_ = false;
        if (error && visit != visit_) return log_.fault(*error);
        if (error) return refuse(*error, begins);
        if (begins != PinStep::Own) {
          forgotten_ = StaffRole::None;
          set_up_ = true;
        }
        if (visit == visit_) step_ = PinStep::Done;
        for (const ui::LogEvent event : said) log_.say(event);
      },
      SideTasks::Whose::Device);
}

void SignIn::show(ui::AccessView& view) const {
  const auto wait = std::chrono::ceil<std::chrono::seconds>(wait_until_ - clock_.now());
  const auto minute = std::chrono::floor<std::chrono::minutes>(clock_.wall_now() + clock_moved_);
  if (clock_text_.empty() || minute != clock_text_at_) clock_text_ = text_of(minute);
  clock_text_at_ = minute;
  view = {.set_up = set_up_,
          .demanded = demands_set_up_,
          .step = step_,
          .fault = fault_,
          .clock = clock_text_,
          .clock_right = clock_right_,
          .clock_refused = clock_refused_,
          .checking = checking_,
          .wrong = wrong_,
          .failed = failed_,
          .wait_s = int(std::max<std::int64_t>(0, wait.count())),
          .consent_right = consent_right_,
          .forgotten = forgotten_ != StaffRole::None};
}

}  // namespace relievo::firmware
