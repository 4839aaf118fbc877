// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_erasure.h"

#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_key_slots.h"

namespace relievo::storage {

Result<void> destroy_subject_key(Database& database, SubjectId id) {
  RELIEVO_TRY(KeySlots(database).write(id, KeySlots::Slot{}));
  RELIEVO_TRY_ASSIGN(auto update, database.prepare("UPDATE subject SET name = x'00', name_hash = NULL, "
                                                   "code = NULL, code_hash = NULL WHERE id = ?"));
  return update.bind(number(id)).run();
}

Result<void> remove_erased_rows(Database& database) {
  // Only of those the log knows as erased: whoever cuts a row short makes nobody disappear without a line.
  return database.run(
      "DELETE FROM subject WHERE code_hash IS NULL AND key_id IS NOT NULL AND EXISTS "
      "(SELECT 1 FROM audit WHERE what = 'subject.erased' AND subject_id = subject.id)");
}

Result<void> empty_the_log(Database& database) {
  RELIEVO_TRY_ASSIGN(const std::int64_t busy, database.integer("PRAGMA wal_checkpoint(TRUNCATE)"));
  if (busy == 0) return {};
  return Error{Errc::Timeout, "erased, but another program keeps traces in the log: close it, then restart"}
      .at(database.where());
}

}  // namespace relievo::storage
