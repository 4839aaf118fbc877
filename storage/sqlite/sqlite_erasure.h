// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a person leaves the store:
//
//   key, name, code destroyed, log emptied ──► unreadable for ever ──► rows removed, log emptied
//                                                    └─ power cut: opening the store goes on from here
// Errors: the database's; Timeout (another program keeps traces in the log). Thread: the store's.
#pragma once

#include "hal/base/result.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"

namespace relievo::storage {

// Inside the caller's transaction, which writes the line of the audit log.
Result<void> destroy_subject_key(Database& database, SubjectId id);

// Of all whose key was destroyed: inside the caller's transaction.
Result<void> remove_erased_rows(Database& database);

// The log still holds the pages as they were: it is moved into the file, and emptied.
Result<void> empty_the_log(Database& database);

}  // namespace relievo::storage
