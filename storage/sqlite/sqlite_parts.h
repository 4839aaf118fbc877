// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the sources of SqliteStore share: the audit log, a person's sealed rows, how they leave the store, how
// an older store becomes one of today, and what every verb that changes something runs in. Included by them
// only. Thread: the store's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"
#include "storage/sqlite/sqlite_store.h"
#include "storage/sqlite/store_directory.h"

namespace relievo::storage {

constexpr std::int64_t number(SubjectId id) { return std::int64_t(id); }
constexpr std::int64_t number(EnrolmentId id) { return std::int64_t(id); }
inline std::int64_t to_ms(WallTime at) { return at.time_since_epoch().count(); }
inline WallTime from_ms(std::int64_t ms) { return WallTime(std::chrono::milliseconds(ms)); }

// The audit log: a chain of lines, each hashed with the store's key together with the end as it was before;
// audit_end is hashed with it, too, so that a cut tail is noticed. Who has no key can make no line, nor
// another line the last. Details are sealed; the hash is of what is stored.

// What the store itself goes by: nobody else may write such lines.
inline constexpr std::string_view kSettingChanged = "setting.changed", kSubjectAdded = "subject.added",
                                  kSubjectErased = "subject.erased", kEnrolmentAdded = "enrolment.added",
                                  kEnrolmentRenewed = "enrolment.renewed",
                                  kRecoveryWordsMade = "store.recovery_words", kRekeyed = "store.rekeyed";

// Of a new store, in the caller's transaction.
Result<void> begin_audit(Database& database, const StoreKeys& keys);

// Inside the caller's transaction. Returns the line's number.
Result<std::int64_t> append_audit_line(Database& database, const StoreKeys& keys, const AuditEvent& event,
                                       WallTime at);

// What is sealed of a line, as plain text. StoreCorrupt: it was changed, or is another line's.
Result<std::string> open_detail(const StoreKeys& keys, std::int64_t line, std::span<const std::byte> sealed);

// StoreCorrupt: a line was edited, dropped, moved, or the tail was cut; or people or enrolments are there
// that it does not tell of, or gone without a line; or what the recovery words open is not what it tells of.
Result<void> check_audit(Database& database, const StoreKeys& keys);

// Whether this was once the end of this log: as audit_end of a copy has it.
Result<bool> ended_so(Database& database, const StoreKeys& keys, std::int64_t number,
                      std::span<const std::byte> end);

// Of a store of version 8, in the transaction of migration 9: its end was no more than the last line's hash.
// The lines are chained anew, so that no log of version 9 passes for one of version 8. What was broken does
// not become whole.
Result<void> key_audit_end(Database& database, const StoreKeys& keys);

// Of a store of before migration 8, in the caller's transaction: details are sealed, the chain is hashed with
// the key. A line whose old hash is not right keeps it: what was broken does not become whole.
Result<void> seal_audit(Database& database, const StoreKeys& keys);

// The rows of a person, sealed with the person's key and opened again. To seal, inside the caller's
// transaction, the row must be there; everything but a subject needs the subject's key in `keys` (take or
// draw it first). Errors: StoreCorrupt names the row and column that was changed or exchanged.

// Seals a store of before migration 8, between migrations 7 and 8:
//
//   7 ──► seal_people(): some at a time, each part a transaction; a power cut goes on with the next person
//     ──► seal_the_rest(): notes, settings, audit log; in the transaction of migration 8 ──► 8
// StoreCorrupt: what was sealed did not come back the same; nothing was changed then.
Result<void> seal_people(Database& database, StoreKeys& keys);
Result<void> seal_the_rest(Database& database, const StoreKeys& keys);

// What SQLite's pages still show of rows that were plain, after migration 8; at every opening until it is
// done. On a disk too full for it nothing is done, and Store::check() says so.
Result<void> remove_plain_traces(Database& database);

// Draws the subject's key. `code`: Subject::receipt.
Result<void> seal_subject(Database& database, StoreKeys& keys, SubjectId id, std::string_view name,
                          std::int64_t code);
// Names are padded: their length tells nothing.
Result<std::string> open_name(const StoreKeys& keys, SubjectId id, std::span<const std::byte> sealed);
Result<std::int64_t> open_code(const StoreKeys& keys, SubjectId id, std::span<const std::byte> sealed);

Result<void> seal_enrolment(Database& database, const StoreKeys& keys, EnrolmentId id,
                            std::string_view algorithms, std::string_view report_json);
// Its algorithms and report.
Result<void> open_enrolment(const StoreKeys& keys, Enrolment& enrolment, std::span<const std::byte> sealed);

Result<void> seal_consent(Database& database, const StoreKeys& keys, EnrolmentId id, const Consent& consent);
Result<Consent> open_consent(const StoreKeys& keys, EnrolmentId id, std::span<const std::byte> sealed);

// `part`: of the row, as ", code_hash".
inline Error corrupt(SubjectId id, Literal what, std::string_view part = {}) {
  return Error{Errc::StoreCorrupt, what}.at("subject " + std::to_string(number(id)) + std::string(part));
}
inline Error corrupt(EnrolmentId id, Literal what) {
  return Error{Errc::StoreCorrupt, what}.at("enrolment " + std::to_string(number(id)));
}
// Of one whose consent or model is gone.
inline Error half_enrolment(EnrolmentId id) {
  return corrupt(id, "a record of the store has lost a part of it: restore a copy");
}

// Makes the row, or takes the place of the one that is there. `blob` is a model_blob.h.
Result<void> seal_model(Database& database, StoreKeys& keys, EnrolmentId id, std::span<const std::byte> blob);
Result<std::vector<std::byte>> open_model(Database& database, StoreKeys& keys, EnrolmentId id);

// How a person leaves the store:
//
//   key, name, code destroyed, log emptied ──► unreadable for ever ──► rows removed, log emptied
//                                                    └─ power cut: opening the store goes on from here
// DIR/relievo.erased remembers everyone who was erased, by a keyed hash of their code's hash (40 bytes: i64
// line of the audit log, hash), which tells nobody who they were. So an older copy of relievo.db that is put
// back in its place is noticed, and who was erased since is erased again when it is opened. Errors: the
// database's; Timeout (another program keeps traces in the log).

// Before their code is destroyed. false: the list cannot be written; an erasure does not wait for it.
Result<bool> remember_erased(Database& database, const StoreKeys& keys, SubjectId id);
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

// Brings an open database to this program's version, or makes a new one.
//
//   empty file ──► schema.sql
//   version n  ──► copied aside ──► migrations n+1 ...
//   version n < 7 ──► copied aside ──► migrations n+1 ... 7 ──► sealed
//              ──► migrations 8 ... ──► the copy removed
//   newer, but compatible with ours ──► used as it is
//   newer ──► StoreNewer, untouched

inline constexpr std::int64_t kApplicationId = 0x524c5631;  // "RLV1"

std::int64_t store_version();  // of this program: the number of its migrations

// Looks, changes nothing. InvalidInput: another program's database. StoreNewer. Returns the version
// of the file, 0 if it is empty.
Result<std::int64_t> version_of(Database& database);

// Afterwards `keys` are those of the store: loaded, or made for one that had none. All in one transaction,
// but for the sealing. MediaFull, IoFailed as every change, and what the keys' source says.
Result<void> make_current(Database& database, std::int64_t version, StoreKeys& keys, WallTime at);

// StoreCorrupt names a table, an index, a trigger or a view that no migration makes, or that is not there.
Result<void> check_schema(Database& database);

// The database as it is now, in a file of 0600 that is whole or not there; until it is whole it is the file
// `unfinished`. IoFailed, MediaFull.
Result<void> copy_whole(Database& database, const std::filesystem::path& target,
                        const std::filesystem::path& unfinished);

// relievo.db.before-N, for each N to `last`: all that this program can have made, or those in which people
// stand in the clear (kAllSealed). What a power cut may have left is found at the next opening.
inline constexpr std::int64_t kAllSealed = 8;  // the migration that sealed what an older store held
Result<void> remove_copies(const std::filesystem::path& database_file, std::int64_t last = store_version());

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

}  // namespace relievo::storage
