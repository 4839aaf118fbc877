// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Seals a store of before migration 8, between migrations 7 and 8:
//
//   7 ──► seal_people(): some at a time, each part a transaction; a power cut goes on with the next person
//     ──► seal_the_rest(): notes, settings, audit log; in the transaction of migration 8 ──► 8
// Errors: as every change. StoreCorrupt: what was sealed did not come back the same; nothing was changed
// then. Thread: the store's.
#pragma once

#include "hal/base/result.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"

namespace relievo::storage {

Result<void> seal_people(Database& database, StoreKeys& keys);
Result<void> seal_the_rest(Database& database, const StoreKeys& keys);

// What SQLite's pages still show of rows that were plain, after migration 8; at every opening until it is
// done. On a disk too full for it nothing is done, and Store::check() says so.
Result<void> remove_plain_traces(Database& database);

}  // namespace relievo::storage
