// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "firmware/kiosk/code/code_guard.h"

#include <algorithm>
#include <chrono>
#include <sstream>

namespace relievo::firmware {
namespace {

constexpr std::int64_t kHourS = 3600;

}  // namespace

Result<CodeGuard::Record> CodeGuard::read() {
  const std::int64_t now_s =
      std::chrono::floor<std::chrono::seconds>(clock_.wall_now()).time_since_epoch().count();
  const Record fresh{0, now_s};
  RELIEVO_TRY_ASSIGN(const std::string text, store_.setting(kCodesSetting));
  if (text.empty()) return fresh;
  std::istringstream in(text);
  Record record;
  if (!(in >> record.wrong >> record.since_s) || record.wrong < 0) return Record{kMostWrongCodes, now_s};
  if (now_s < record.since_s) record.since_s = now_s;
  return now_s - record.since_s >= kHourS ? fresh : record;
}

Result<void> CodeGuard::write(const Record& record) {
  return store_.set_setting(kCodesSetting,
                            std::to_string(record.wrong) + " " + std::to_string(record.since_s));
}

Result<bool> CodeGuard::spend() {
  RELIEVO_TRY_ASSIGN(Record record, read());
  if (record.wrong >= kMostWrongCodes) {
    RELIEVO_TRY(write(record));  // an hour that began anew is kept
    return false;
  }
  ++record.wrong;
  RELIEVO_TRY(write(record));
  return true;
}

Result<void> CodeGuard::was_right() {
  RELIEVO_TRY_ASSIGN(Record record, read());
  record.wrong = std::max(0, record.wrong - 1);
  return write(record);
}

}  // namespace relievo::firmware
