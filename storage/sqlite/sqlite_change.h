// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every verb of SqliteStore that changes something runs in. Included by their sources only.
#pragma once

#include "storage/sqlite/sqlite_erasure.h"
#include "storage/sqlite/sqlite_store.h"
#include "storage/sqlite/store_directory.h"

namespace relievo::storage {

template <typename Work>
auto SqliteStore::change(const Work& work) -> decltype(work(WallTime{})) {
  if (mode_ == OpenMode::ReadOnly) {
    return Error{Errc::InvalidState, "the store was opened to read only"}.at(database_->where());
  }
  return without_exceptions(database_->where(), [&]() -> decltype(work(WallTime{})) {
    Transaction transaction(*database_);
    RELIEVO_TRY(transaction.begin());
    auto done = work(now());
    if (!done) return done;
    RELIEVO_TRY(transaction.commit());
    if (traces_left_) traces_left_ = !empty_the_log(*database_);
    return done;
  });
}

// The way out of a full disk, and into the pages that lead there, may not itself end there. Who calls
// it sets the reserve aside again afterwards.
template <typename Work>
auto SqliteStore::change_in_reserve(const Work& work) -> decltype(work(WallTime{})) {
  auto done = change(work);
  if (!done && done.error().code == Errc::MediaFull && give_up_reserve(home_)) done = change(work);
  return done;
}

constexpr std::int64_t number(SubjectId id) { return std::int64_t(id); }
constexpr std::int64_t number(EnrolmentId id) { return std::int64_t(id); }
inline std::int64_t to_ms(WallTime at) { return at.time_since_epoch().count(); }
inline WallTime from_ms(std::int64_t ms) { return WallTime(std::chrono::milliseconds(ms)); }

}  // namespace relievo::storage
