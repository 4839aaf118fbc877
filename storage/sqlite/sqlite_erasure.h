// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a person leaves the store:
//
//   key, name, code destroyed, log emptied ──► unreadable for ever ──► rows removed, log emptied
//                                                    └─ power cut: opening the store goes on from here
// DIR/relievo.erased remembers everyone who was erased, by a keyed hash of their code's hash (40 bytes: i64
// line of the audit log, hash), which tells nobody who they were. So an older copy of relievo.db that is put
// back in its place is noticed, and who was erased since is erased again when it is opened. Errors: the
// database's; Timeout (another program keeps traces in the log). Thread: the store's.
#pragma once

#include <vector>

#include "hal/base/result.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"

namespace relievo::storage {

// Before their code is destroyed. That the list cannot be written is no error: an erasure does not wait for
// it.
Result<void> remember_erased(Database& database, const StoreKeys& keys, SubjectId id);
// Whom this database still has although they were erased after it was copied.
Result<std::vector<SubjectId>> erased_and_back(Database& database, const StoreKeys& keys);

// Whether this is the code of somebody the store has erased: it stands as such a hash in that file, and in
// the log's line of the erasure, which copies of the store have, too.
Result<bool> was_erased(Database& database, const StoreKeys& keys, std::int64_t code);

// Inside the caller's transaction; with its line of the audit log.
Result<void> destroy_subject_key(Database& database, const StoreKeys& keys, SubjectId id, WallTime at);

// Of all whose key was destroyed: inside the caller's transaction.
Result<void> remove_erased_rows(Database& database);

// The log still holds the pages as they were: it is moved into the file, and emptied.
Result<void> empty_the_log(Database& database);

}  // namespace relievo::storage
