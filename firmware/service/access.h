// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Access: who may go to the staff's side. Two PINs, kept stretched in the store's setting "access", with
// the count of wrong tries: it is written before a PIN is looked at, so that pulling the plug gives no
// further try. A wrong PIN makes the next wait; from the fifth on for minutes, an hour at most.
// A clock that was set back begins the wait anew.
//
// Thread: the keeper, as the store. Errors: the store's; StoreCorrupt (the setting cannot be read).
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "hal/clock.h"
#include "storage/store.h"
#include "ui/view/service_view.h"

namespace relievo::firmware {

// A PIN as it may be kept: salted and stretched by Argon2id (RFC 9106; 19 MiB, two passes, as OWASP's
// password sheet asks for at least). Takes about 40 ms and its memory from the heap.
// Thread: any (the keeper). Errors: OutOfMemory.
Result<std::string> stretched(std::string_view pin);
Result<bool> is_pin_of(std::string_view pin, const std::string& kept);  // false, too, where there is none
void wipe_text(std::string& text);

inline constexpr const char* kAccessSetting = "access";

struct Attempt {
  ui::StaffRole role = ui::StaffRole::None;  // None: wrong, or too early
  bool wrong = false;
  std::chrono::seconds wait{0};  // until the next try
  bool locked = false;           // it was put off for minutes; else for a moment
};

// How long the next try is put off after so many wrong ones in a row.
std::chrono::seconds wait_after(int wrong);
// All digits alike, or one after the other.
bool is_simple(std::string_view pin);

class Access {
 public:
  Access(storage::Store& store, const hal::Clock& clock) : store_(store), clock_(clock) {}

  Result<bool> is_set_up();
  // Of whom one has been forgotten while the other role's is there; None: of nobody, or of both.
  Result<ui::StaffRole> forgotten();
  Result<std::chrono::seconds> wait();
  // Was the next try put off for minutes, however many of them are left? Else for a moment.
  Result<bool> is_locked();
  Result<Attempt> attempt(std::string_view pin);
  // InvalidInput: not four to eight digits, or too simple. InvalidState: the other role has it.
  Result<void> check_new(ui::StaffRole role, std::string_view pin);
  Result<void> set(ui::StaffRole role, std::string_view pin);
  // Its PIN is no more; wrong tries stay counted. InvalidState: it has none.
  Result<void> forget(ui::StaffRole role);
  // In the place of one that was forgotten. InvalidState: it was not. Else as check_new().
  Result<void> choose_again(ui::StaffRole role, std::string_view pin);
  // Both at once: a device is set up or it is not.
  Result<void> set_up(std::string_view technician_pin, std::string_view operator_pin);

 private:
  struct Record {
    std::string technician_pin, operator_pin;  // stretched
    std::string& of(ui::StaffRole role) {
      return role == ui::StaffRole::Technician ? technician_pin : operator_pin;
    }
    int wrong = 0;
    std::int64_t wrong_at_s = 0;  // seconds since 1970, of the last wrong try
  };
  Result<Record> read();
  Result<void> write(const Record& record);
  Result<std::chrono::seconds> wait(Record& record);
  std::int64_t now_s() const;

  storage::Store& store_;
  const hal::Clock& clock_;
};

}  // namespace relievo::firmware
