// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore: people who go from one store to another.
#include "storage/calibration_record.h"
#include "storage/model_blob.h"
#include "storage/receipt_number.h"
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_erasure.h"

namespace relievo::storage {
namespace {

// Without its number, which is this store's own.
Result<std::vector<std::byte>> calibration_of(Database& database, std::uint32_t revision) {
  if (revision == 0) return std::vector<std::byte>();
  RELIEVO_TRY_ASSIGN(auto query, database.prepare("SELECT record FROM calibration WHERE revision = ?"));
  RELIEVO_TRY(query.bind(std::int64_t{revision}).step());
  RELIEVO_TRY_ASSIGN(auto stored, decode_calibration(query.blob(0)));
  stored.calibration.revision = 0;
  return encode_calibration(stored.calibration, stored.figures);
}

}  // namespace

Result<PersonRecord> SqliteStore::person(SubjectId id) {
  return without_exceptions(database_->where(), [&]() -> Result<PersonRecord> {
    RELIEVO_TRY_ASSIGN(Subject known, subject(id));
    RELIEVO_TRY_ASSIGN(auto kept, enrolments(id));
    PersonRecord person{std::move(known.name), known.receipt, known.created_at, {}};
    for (Enrolment& one : kept) {
      PersonRecord::Portrait portrait{one.created_at,
                                      std::move(one.consent),
                                      std::move(one.algorithms),
                                      std::move(one.report_json),
                                      {},
                                      {}};
      RELIEVO_TRY_ASSIGN(portrait.calibration, calibration_of(*database_, one.calibration_revision));
      RELIEVO_TRY_ASSIGN(portrait.model, model_bytes(one.id));
      person.portraits.push_back(std::move(portrait));
    }
    return person;
  });
}

Result<void> SqliteStore::must_be_new(std::int64_t receipt) {
  if (receipt < kLeastReceipt || receipt > kMostReceipt)
    return Error{Errc::InvalidInput, "this person's code is none that a store gives"};
  RELIEVO_TRY_ASSIGN(const bool erased, was_erased(*database_, *keys_, receipt));
  if (erased)
    return Error{Errc::InvalidInput,
                 "this person was erased from this store after the copy was made: it brings nobody back"};
  const auto hash = keys_->code_hash(receipt);
  RELIEVO_TRY_ASSIGN(auto query, database_->prepare("SELECT id FROM subject WHERE code_hash = ?"));
  RELIEVO_TRY_ASSIGN(const bool row, query.bind(hash).step());
  if (!row) return {};
  return Error{Errc::InvalidInput, "somebody with this person's code is in the store: nothing was changed"}
      .at("subject " + std::to_string(query.integer(0)));
}

Result<SubjectId> SqliteStore::add_person(const PersonRecord& person) {
  return change([&](WallTime at) -> Result<SubjectId> {
    RELIEVO_TRY(must_be_new(person.receipt));
    RELIEVO_TRY_ASSIGN(const SubjectId id,
                       insert_subject(person.name, person.receipt, person.created_at, at));
    for (const PersonRecord::Portrait& one : person.portraits) {
      RELIEVO_TRY_ASSIGN(const auto model, decode_model(one.model, std::pmr::new_delete_resource()));
      RELIEVO_TRY_ASSIGN(const std::uint32_t revision, revision_for(one.calibration, at));
      const NewEnrolment enrolment{model, one.consent, revision, one.algorithms, one.report_json};
      RELIEVO_TRY(check_texts(enrolment));
      RELIEVO_TRY(insert_enrolment(id, enrolment, one.model, one.created_at, at));
    }
    RELIEVO_TRY(append_audit_line(*database_, *keys_, {"subject.taken_in", id, ""}, at));
    return id;
  });
}

}  // namespace relievo::storage
