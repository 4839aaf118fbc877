// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/staff/staff_controller.h"

#include <utility>

#include "firmware/base/wall_time.h"
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

Result<void> SignIn::look() {
  view_.demanded = services_.device.is_live();
  RELIEVO_TRY_ASSIGN(view_.set_up, access_.is_set_up());
  RELIEVO_TRY_ASSIGN(forgotten_, access_.forgotten());
  RELIEVO_TRY_ASSIGN(const auto wait, access_.wait());
  RELIEVO_TRY_ASSIGN(view_.locked, access_.is_locked());
  wait_until_ = services_.device.clock().now() + wait;
  return {};
}

void SignIn::opened(StaffPage page) {
  forget();
  view_.wrong = view_.clock_right = view_.clock_refused = view_.consent_right = false;
  view_.failed.reset();
  if (page == StaffPage::FirstStart) services_.consent.opened();
  clock_moved_ = std::chrono::minutes(0);
  home_.reset();
  view_.fault = PinFault::None;
  view_.step = page == StaffPage::Pins             ? PinStep::Own
               : forgotten_ == StaffRole::Operator ? PinStep::Operator
                                                   : PinStep::Technician;
}

void SignIn::forget() {
  ++visit_;
  entered_ = StaffRole::None;
  first_.wipe();
  technician_.wipe();
}

void SignIn::ask(const ui::StaffRequest& request, StaffRole role) {
  if (view_.checking) return;
  if (request.page == StaffPage::Pin && request.as<ui::CheckPin>() != nullptr) return check(request.text());
  const bool first = request.page == StaffPage::FirstStart && !view_.set_up;
  const bool clock = first || (request.page == StaffPage::Clock && role != StaffRole::None);
  if (request.as<ui::OfferPin>() != nullptr &&
      (first || (request.page == StaffPage::Pins && role != StaffRole::None)))
    return offer(request.text(), role);
  const auto* move = request.as<ui::MoveClock>();
  if (clock && move != nullptr) clock_moved_ += std::chrono::minutes(move->minutes);
  if (clock && request.as<ui::SetClock>() != nullptr) set_clock();
  if (!first) return;
  if (const auto* home = request.as<ui::ChooseHome>()) home_ = home->language;
  if (request.as<ui::TakeConsentText>() != nullptr) services_.consent.take();
  if (request.as<ui::ConfirmConsentText>() != nullptr) view_.consent_right = true;
}

void SignIn::set_clock() {
  view_.clock_right = true;
  if (view_.clock_refused) return;
  if (clock_moved_.count() == 0) return confirm_clock();
  const Result<void> set = set_clock_
                               ? set_clock_(services_.device.clock().wall_now() + clock_moved_)
                               : Result<void>(Error{Errc::Unsupported, "this board's clock cannot be set"});
  clock_moved_ = std::chrono::minutes(0);
  view_.clock_right = set.has_value();
  view_.clock_refused = !set;
  if (!set) return services_.log.fault(set.error());
  services_.log.say(ui::LogEvent::ClockSet);
  confirm_clock();
}

void SignIn::confirm_clock() {
  clock_confirmed_ = true;
  services_.side_tasks.send(
      JobLane::Keeper,
      [&store = services_.store, now = stored_time(services_.device.clock().wall_now())](JobControl&) {
        return trust_clock(store, now);
      },
      [&log = services_.log](const std::optional<Error>& error) {
        if (error) log.fault(*error);
      },
      SideTasks::Whose::Device);
}

void SignIn::check(std::string_view pin) {
  view_.checking = true;
  services_.side_tasks.ask(
      JobLane::Keeper,
      [this, kept = std::make_shared<WipedText>(pin)](JobControl&) {
        const auto answer = access_.attempt(kept->view());
        kept->wipe();
        return answer;
      },
      [this, visit = visit_](const Result<Attempt>& answer) {
        view_.checking = false;
        if (!answer) services_.log.fault(answer.error());
        const Attempt attempt = answer ? *answer : Attempt();
        wait_until_ = services_.device.clock().now() + attempt.wait;
        view_.locked = attempt.locked;
        if (attempt.wrong) services_.log.say(ui::LogEvent::WrongPin);
        if (visit != visit_) return;  // whoever typed it has gone: the next one at the lock is another
        view_.failed = answer ? std::nullopt : std::optional(answer.error().code);
        view_.wrong = attempt.wrong;
        entered_ = attempt.role;
        if (entered_ == StaffRole::Technician) services_.log.say(ui::LogEvent::TechnicianSignedIn);
        if (entered_ == StaffRole::Operator) services_.log.say(ui::LogEvent::OperatorSignedIn);
      },
      SideTasks::Whose::Device);
}

// The first time a PIN is judged, the second time it is compared.
void SignIn::offer(std::string_view pin, StaffRole role) {
  view_.fault = PinFault::None;
  view_.failed.reset();
  switch (view_.step) {
    case PinStep::Technician: return judge(pin, StaffRole::Technician, PinStep::TechnicianAgain);
    case PinStep::Operator:
      if (pin == technician_.view()) {
        view_.fault = PinFault::Taken;
        return;
      }
      return judge(pin, StaffRole::Operator, PinStep::OperatorAgain);
    case PinStep::Own: return judge(pin, role, PinStep::OwnAgain);
    case PinStep::TechnicianAgain:
    case PinStep::OperatorAgain:
    case PinStep::OwnAgain: return offered_again(pin, role);
    case PinStep::Done: return;
  }
}

void SignIn::offered_again(std::string_view pin, StaffRole role) {
  const PinStep before = view_.step == PinStep::TechnicianAgain ? PinStep::Technician
                         : view_.step == PinStep::OperatorAgain ? PinStep::Operator
                                                                : PinStep::Own;
  if (pin != first_.view()) {
    view_.fault = PinFault::Differ;
    view_.step = before;
    return first_.wipe();
  }
  if (before == PinStep::Own) {
    save({first_, {}}, before, [this, role](const Pins& pins) { return access_.set(role, pins.one.view()); },
         {chosen_by(role)});
  } else if (forgotten_ != StaffRole::None) {
    save(
        {first_, {}}, before,
        [this, whose = forgotten_](const Pins& pins) { return access_.choose_again(whose, pins.one.view()); },
        {chosen_by(forgotten_)});
  } else if (before == PinStep::Operator) {
    save({technician_, first_}, PinStep::Technician,
         [this](const Pins& pins) { return access_.set_up(pins.one.view(), pins.operators.view()); },
         {ui::LogEvent::TechnicianPinChosen, ui::LogEvent::OperatorPinChosen});
    technician_.wipe();
  } else {
    technician_ = first_;
    view_.step = PinStep::Operator;
  }
  first_.wipe();
}

void SignIn::judge(std::string_view pin, StaffRole role, PinStep next) {
  const auto kept = std::make_shared<WipedText>(pin);
  view_.checking = true;
  services_.side_tasks.send(
      JobLane::Keeper, [this, kept, role](JobControl&) { return access_.check_new(role, kept->view()); },
      [this, kept, next, visit = visit_](const std::optional<Error>& error) {
        view_.checking = false;
        if (visit != visit_) return;
        if (error) return refuse(*error, view_.step);
        first_ = *kept;
        view_.step = next;
      },
      SideTasks::Whose::Device);
}

void SignIn::refuse(const Error& error, PinStep again) {
  view_.step = again;
  if (error.code == Errc::InvalidState) view_.fault = PinFault::Taken;
  else if (error.code == Errc::InvalidInput) view_.fault = PinFault::Simple;
  else view_.failed = error.code, services_.log.fault(error);
}

// A PIN is kept by the keeper and known to nobody then. One of the two that was forgotten is chosen alone; a
// device that is new has both at once or none.
void SignIn::save(const Pins& pins, PinStep begins, std::function<Result<void>(const Pins&)> write,
                  std::vector<ui::LogEvent> said) {
  const auto kept = std::make_shared<Pins>(pins);
  view_.checking = true;
  services_.side_tasks.send(
      JobLane::Keeper,
      [kept, write = std::move(write)](JobControl&) {
        const Result<void> saved = write(*kept);
        *kept = {};
        return saved;
      },
      [this, begins, said = std::move(said), home = home_,
       visit = visit_](const std::optional<Error>& error) {
        view_.checking = false;
        if (error && visit != visit_) return services_.log.fault(*error);
        if (error) return refuse(*error, begins);
        if (begins != PinStep::Own) {
          forgotten_ = StaffRole::None;
          view_.set_up = true;
          if (home) settle_in(*home);
        }
        if (visit == visit_) view_.step = PinStep::Done;
        for (const ui::LogEvent event : said) services_.log.say(event);
      },
      SideTasks::Whose::Device);
}

// Who sets a device up chooses for its visitors, too.
void SignIn::settle_in(ui::Language home) {
  if (services_.settings.wanted().of(ui::Setting::Language) == std::int32_t(home)) return;
  services_.settings.change(ui::Setting::Language, std::int32_t(home), [](const std::optional<Error>&) {});
}

void SignIn::show(ui::AccessView& view) const {
  const auto wait = std::chrono::ceil<std::chrono::seconds>(wait_until_ - services_.device.clock().now());
  const auto minute =
      std::chrono::floor<std::chrono::minutes>(services_.device.clock().wall_now() + clock_moved_);
  if (clock_text_.empty() || minute != clock_text_at_) clock_text_ = text_of(minute);
  clock_text_at_ = minute;
  view = view_;
  view.clock = clock_text_;
  view.wait_s = int(std::max<std::int64_t>(0, wait.count()));
  view.forgotten = forgotten_ != StaffRole::None;
}

}  // namespace relievo::firmware
