// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The audit log: a chain of lines, each hashed together with the one before; audit_end repeats the
// last, so that a cut tail is noticed. It shows damage and clumsy edits; whoever can write the file
// and knows the program can make a new chain.
// Thread: the store's.
#pragma once

#include "hal/base/result.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"

namespace relievo::storage {

// Inside the caller's transaction.
Result<void> append_audit_line(Database& database, const AuditEvent& event, WallTime at);

// StoreCorrupt: a line was edited, dropped, moved, or the tail was cut.
Result<void> check_audit_chain(Database& database);

}  // namespace relievo::storage
