// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CodeGuard: how many wrong codes of records are listened to: kMostWrongCodes an hour, whoever types them
// and however often the program is started. Kept in the store's setting "codes", and written before a code
// is looked at, so that pulling the plug gives no further try. A clock that was set back begins the hour
// anew. A setting that cannot be read counts as a full hour. Thread: the keeper, as the store. Errors: the
// store's.
#pragma once

#include "hal/clock.h"
#include "storage/store.h"

namespace relievo::firmware {

inline constexpr const char* kCodesSetting = "codes";
inline constexpr int kMostWrongCodes = 10;

class CodeGuard {
 public:
  CodeGuard(storage::Store& store, const hal::Clock& clock) : store_(store), clock_(clock) {}

  // May one more be looked at? It counts as wrong until was_right().
  Result<bool> spend();
  Result<void> was_right();

 private:
  struct Record {
    int wrong = 0;
    std::int64_t since_s = 0;  // seconds since 1970, of the first wrong one
  };
  Result<Record> read();
  Result<void> write(const Record& record);

  storage::Store& store_;
  const hal::Clock& clock_;
};

}  // namespace relievo::firmware
