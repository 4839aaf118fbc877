// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/view/service.h"

#include "hal/base/utf8.h"
#include "ui/view/view_state.h"

namespace relievo::ui {

bool Service::takes(ActionKind kind) const {
  if (kind == ActionKind::StaffEnter) return true;
  // Language, text size and help are the same for everybody.
  const bool staff = kind > ActionKind::StaffEnter || kind == ActionKind::TypeKey ||
                     kind == ActionKind::Erase || kind == ActionKind::Back;
  return open && staff;
}

void Service::enter(const ViewState& view) {
  if (open || view.service == nullptr) return;
  open = true;
  last_touch_ = view.now;
  go(view.service->access.set_up ? StaffPage::Pin : StaffPage::FirstStart);
}

void Service::act(const Action& action, const ViewState& view) {
  const ActionKind kind = action.kind;
  if (kind == ActionKind::StaffEnter) enter(view);
  if (kind == ActionKind::StaffOpen) go(static_cast<StaffPage>(action.value));
  if (kind == ActionKind::StaffDo || kind == ActionKind::StaffAnswer) request(action.ask);
  if (kind == ActionKind::StaffAnswer || kind == ActionKind::StaffMode) mode = action.value;
  if (kind == ActionKind::StaffMode) ruler = {};
  if (kind == ActionKind::StaffMeasure) ruler = {.on = !ruler.on};
  if (kind == ActionKind::StaffLeave) leave();
  if (kind == ActionKind::Erase) typed_.cut(last_letter_at(typed()));
  if (kind == ActionKind::Back) back(view.service != nullptr && view.service->inner);
}

void Service::leave() {
  request(PageLeft{});
  close();
}

void Service::back(bool inner) {
  if (mode != 0) {
    mode = 0;
    ruler = {};
    return;
  }
  if (inner) return go(page);
  if (page != StaffPage::Menu && needs_role(page)) return go(StaffPage::Menu);
  leave();
}

void Service::type(std::string_view letter) {
  const bool digit = letter.size() == 1 && letter[0] >= '0' && letter[0] <= '9';
  if (!digits_only() || (digit && typed().size() < kMostPinDigits)) typed_.add(letter);
}

void Service::show(StaffPage which, int in_mode) {
  open = true;
  page = which;
  mode = in_mode;
}

void Service::go(StaffPage to) {
  close();
  open = true;
  page = to;
  request(PageOpened{});
}

void Service::close() {
  typed_.wipe();
  open = false;
  page = StaffPage::Pin;
  mode = 0;
  ruler = {};
}

void Service::request(const StaffAsk& ask) {
  if (request_count_ < requests_.size()) requests_[request_count_++] = {page, ask, typed_};
  // A PIN is not kept longer than its check, a name not longer than its search; nor where it cannot be asked.
  if (!std::holds_alternative<PageOpened>(ask)) typed_.wipe();
}

std::optional<StaffRequest> Service::take_request() {
  if (request_count_ == 0) return std::nullopt;
  const StaffRequest first = requests_[0];
  std::move(requests_.begin() + 1, requests_.begin() + std::ptrdiff_t(request_count_), requests_.begin());
  requests_[--request_count_].typed.wipe();
  return first;
}

void Service::follow(const ViewState& view) {
  // Whoever comes first would choose the PINs: that is the staff, before there are visitors.
  if (!open && view.service != nullptr && view.service->access.demanded && !view.service->access.set_up &&
      (view.screen == Screen::Idle || view.screen == Screen::Fault))
    enter(view);
  if (!open) return;
  if (view.service == nullptr) return close();
  const StaffRole role = view.service->role;
  if (needs_role(page) && role == StaffRole::None) return close();
  // Before real people nobody forgets the sheet: its page comes first until it is confirmed.
  const AccessView& access = view.service->access;
  const bool sheet = access.demanded && access.words_due && role == StaffRole::Operator;
  if (!needs_role(page) && role != StaffRole::None) return go(sheet ? StaffPage::Recovery : StaffPage::Menu);
  if (page == StaffPage::FirstStart && view.service->access.set_up) return go(StaffPage::Pin);
  constexpr std::chrono::minutes kSetUpPatience{5};
  if (page == StaffPage::FirstStart && view.now - last_touch_ > kSetUpPatience) return leave();
  if (page == StaffPage::Pin && view.now - last_touch_ > kPinPatience) leave();
}

}  // namespace relievo::ui
