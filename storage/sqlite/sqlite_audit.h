// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The audit log: a chain of lines, each hashed with the store's key together with the one before; audit_end
// repeats the last, so that a cut tail is noticed. Who has no key can make no line. Details are sealed; the
// hash is of what is stored. Thread: the store's.
#pragma once

#include "hal/base/result.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"

namespace relievo::storage {

// What the store itself goes by: nobody else may write such lines.
inline constexpr std::string_view kSettingChanged = "setting.changed", kSubjectErased = "subject.erased";

// Inside the caller's transaction. Returns the line's number.
Result<std::int64_t> append_audit_line(Database& database, const StoreKeys& keys, const AuditEvent& event,
                                       WallTime at);

// What is sealed of a line, as plain text. StoreCorrupt: it was changed, or is another line's.
Result<std::string> open_detail(const StoreKeys& keys, std::int64_t line, std::span<const std::byte> sealed);

// StoreCorrupt: a line was edited, dropped, moved, or the tail was cut.
Result<void> check_audit_chain(Database& database, const StoreKeys& keys);

// Of a store of before migration 8, in the caller's transaction: details are sealed, the chain is hashed with
// the key. A line whose old hash is not right keeps it: what was broken does not become whole.
Result<void> seal_audit(Database& database, const StoreKeys& keys);

}  // namespace relievo::storage
