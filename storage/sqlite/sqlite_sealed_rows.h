// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rows of a person, sealed with the person's key and opened again. To seal, inside the caller's
// transaction, the row must be there; everything but a subject needs the subject's key in `keys` (take or
// draw it first). Errors: StoreCorrupt names the row and column that was changed or exchanged. Thread: the
// store's.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/result.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_database.h"
#include "storage/sqlite/sqlite_keys.h"

namespace relievo::storage {

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

// Makes the row, or takes the place of the one that is there. `blob` is a model_blob.h.
Result<void> seal_model(Database& database, StoreKeys& keys, EnrolmentId id, std::span<const std::byte> blob);
Result<std::vector<std::byte>> open_model(Database& database, StoreKeys& keys, EnrolmentId id);

}  // namespace relievo::storage
