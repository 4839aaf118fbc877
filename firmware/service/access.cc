// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/service/access.h"

#include <algorithm>
#include <sstream>

#include "ui/view/service.h"

namespace relievo::firmware {
namespace {

using std::chrono::seconds;

constexpr std::string_view kNone = "-";  // no PIN has been chosen
constexpr int kFreeTries = 4;            // each makes the next wait a little
constexpr seconds kFirstLock{300}, kLongestLock{3600};

}  // namespace

seconds wait_after(int wrong) {
  if (wrong <= 0) return seconds(0);
  if (wrong <= kFreeTries) return seconds(1 << (wrong - 1));
  const int doubled = std::min(wrong - kFreeTries - 1, 8);
  return std::min(kLongestLock, kFirstLock * (1 << doubled));
}

bool is_simple(std::string_view pin) {
  bool same = true, up = true, down = true;
  for (std::size_t i = 1; i < pin.size(); ++i) {
    same = same && pin[i] == pin[i - 1];
    up = up && pin[i] == pin[i - 1] + 1;
    down = down && pin[i] == pin[i - 1] - 1;
  }
  return same || up || down;
}

std::int64_t Access::now_s() const {
  return std::chrono::floor<seconds>(clock_.wall_now()).time_since_epoch().count();
}

Result<Access::Record> Access::read() {
  RELIEVO_TRY_ASSIGN(const std::string text, store_.setting(kAccessSetting));
  if (text.empty()) return Record{};
  std::istringstream in(text);
  Record record;
  std::string version;
  if (!(in >> version >> record.technician_pin >> record.operator_pin >> record.wrong >> record.wrong_at_s) ||
      version != "1" || record.wrong < 0)
    return Error{Errc::StoreCorrupt, "the staff's PINs cannot be read: restore a copy of the store"};
  if (record.technician_pin == kNone) record.technician_pin.clear();
  if (record.operator_pin == kNone) record.operator_pin.clear();
  return record;
}

Result<void> Access::write(const Record& record) {
  std::ostringstream out;
  const auto word = [](const std::string& kept) { return kept.empty() ? std::string(kNone) : kept; };
  out << "1 " << word(record.technician_pin) << ' ' << word(record.operator_pin) << ' ' << record.wrong << ' '
      << record.wrong_at_s;
  return store_.set_setting(kAccessSetting, out.str());
}

Result<bool> Access::is_set_up() {
  RELIEVO_TRY_ASSIGN(const Record record, read());
  return !record.technician_pin.empty() && !record.operator_pin.empty();
}

Result<ui::StaffRole> Access::forgotten() {
  RELIEVO_TRY_ASSIGN(const Record record, read());
  if (record.technician_pin.empty() == record.operator_pin.empty()) return ui::StaffRole::None;
  return record.technician_pin.empty() ? ui::StaffRole::Technician : ui::StaffRole::Operator;
}

Result<seconds> Access::wait(Record& record) {
  const std::int64_t now = now_s();
  if (record.wrong > 0 && now < record.wrong_at_s) {
    record.wrong_at_s = now;
    RELIEVO_TRY(write(record));
  }
  return std::max(seconds(0), wait_after(record.wrong) - seconds(now - record.wrong_at_s));
}

Result<seconds> Access::wait() {
  RELIEVO_TRY_ASSIGN(Record record, read());
  return wait(record);
}

Result<bool> Access::is_locked() {
  RELIEVO_TRY_ASSIGN(const Record record, read());
  return record.wrong > kFreeTries;
}

Result<Attempt> Access::attempt(std::string_view pin) {
  RELIEVO_TRY_ASSIGN(Record record, read());
  RELIEVO_TRY_ASSIGN(const seconds early, wait(record));
  if (early > seconds(0)) return Attempt{ui::StaffRole::None, false, early, record.wrong > kFreeTries};
  ++record.wrong;
  record.wrong_at_s = now_s();
  RELIEVO_TRY(write(record));
  // Both are looked at, whichever it is: the time tells nothing.
  const Result<bool> technicians = is_pin_of(pin, record.technician_pin),
                     operators = is_pin_of(pin, record.operator_pin);
  if (!technicians || !operators) {
    --record.wrong;  // nobody knows
    RELIEVO_TRY(write(record));
    return technicians ? operators.error() : technicians.error();
  }
  if (!*technicians && !*operators)
    return Attempt{ui::StaffRole::None, true, wait_after(record.wrong), record.wrong > kFreeTries};
  record.wrong = 0;
  RELIEVO_TRY(write(record));
  return Attempt{*technicians ? ui::StaffRole::Technician : ui::StaffRole::Operator};
}

Result<void> Access::check_new(ui::StaffRole role, std::string_view pin) {
  const bool digits = std::all_of(pin.begin(), pin.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || pin.size() < ui::kLeastPinDigits || pin.size() > ui::kMostPinDigits)
    return invalid("a PIN has four to eight digits");
  if (is_simple(pin)) return invalid("this PIN is too easy to guess: choose another");
  RELIEVO_TRY_ASSIGN(const Record record, read());
  RELIEVO_TRY_ASSIGN(
      const bool taken,
      is_pin_of(pin, role == ui::StaffRole::Technician ? record.operator_pin : record.technician_pin));
  if (taken) return Error{Errc::InvalidState, "the other role has this PIN: choose another"};
  return {};
}

Result<void> Access::set(ui::StaffRole role, std::string_view pin) {
  RELIEVO_TRY(check_new(role, pin));
  RELIEVO_TRY_ASSIGN(Record record, read());
  if (record.technician_pin.empty() || record.operator_pin.empty())
    return Error{Errc::InvalidState, "choose both PINs first"};
  RELIEVO_TRY_ASSIGN(record.of(role), stretched(pin));
  return write(record);
}

Result<void> Access::forget(ui::StaffRole role) {
  RELIEVO_TRY_ASSIGN(Record record, read());
  std::string& kept = record.of(role);
  if (kept.empty()) return Error{Errc::InvalidState, "has no PIN: it is chosen at the screen"};
  kept.clear();
  return write(record);
}

Result<void> Access::choose_again(ui::StaffRole role, std::string_view pin) {
  RELIEVO_TRY(check_new(role, pin));
  RELIEVO_TRY_ASSIGN(Record record, read());
  std::string& kept = record.of(role);
  if (!kept.empty()) return Error{Errc::InvalidState, "has a PIN already"};
  RELIEVO_TRY_ASSIGN(kept, stretched(pin));
  return write(record);
}

Result<void> Access::set_up(std::string_view technician_pin, std::string_view operator_pin) {
  RELIEVO_TRY(check_new(ui::StaffRole::Technician, technician_pin));
  RELIEVO_TRY(check_new(ui::StaffRole::Operator, operator_pin));
  if (technician_pin == operator_pin)
    return Error{Errc::InvalidState, "the other role has this PIN: choose another"};
  Record record;
  RELIEVO_TRY_ASSIGN(record.technician_pin, stretched(technician_pin));
  RELIEVO_TRY_ASSIGN(record.operator_pin, stretched(operator_pin));
  return write(record);
}

}  // namespace relievo::firmware
