// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore: the long check.
#include <algorithm>

#include "storage/calibration_record.h"
#include "storage/model_blob.h"
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_erasure.h"
#include "storage/sqlite/sqlite_sealed_rows.h"
#include "storage/sqlite/sqlite_settings.h"

namespace relievo::storage {

Result<void> SqliteStore::check() {
  return without_exceptions(database_->where(), [&]() -> Result<void> {
    RELIEVO_TRY(check_pages());
    RELIEVO_TRY(check_calibrations());
    RELIEVO_TRY(check_subjects());
    RELIEVO_TRY(check_models());
    RELIEVO_TRY(read_settings(*database_, *keys_));
    return check_audit_chain(*database_, *keys_);
  });
}

Result<void> SqliteStore::check_pages() {
  RELIEVO_TRY_ASSIGN(auto pages, database_->prepare("PRAGMA integrity_check(1)"));
  RELIEVO_TRY_ASSIGN(const bool row, pages.step());
  if (!row || pages.text(0) != "ok") {
    return Error{Errc::StoreCorrupt, "the store is damaged: stop using it and restore a copy"}.at(
        database_->where());
  }
  RELIEVO_TRY_ASSIGN(auto owners, database_->prepare("PRAGMA foreign_key_check"));
  RELIEVO_TRY_ASSIGN(const bool orphan, owners.step());
  RELIEVO_TRY_ASSIGN(
      const std::int64_t halves,
      database_->integer(
          "SELECT count(*) FROM enrolment WHERE NOT EXISTS (SELECT 1 FROM model WHERE enrolment_id = "
          "enrolment.id) OR NOT EXISTS (SELECT 1 FROM consent WHERE enrolment_id = enrolment.id)"));
  if (orphan || halves != 0) {
    return Error{Errc::StoreCorrupt, "a record of the store has lost a part of it: restore a copy"}.at(
        database_->where());
  }
  return {};
}

Result<void> SqliteStore::check_calibrations() {
  RELIEVO_TRY_ASSIGN(auto query, database_->prepare("SELECT revision FROM calibration"));
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) break;
    RELIEVO_TRY_ASSIGN(const auto read, calibration(static_cast<std::uint32_t>(query.integer(0))));
    RELIEVO_TRY(check_calibration(read));
  }
  RELIEVO_TRY(calibrations());  // their notes
  return {};
}

Result<void> SqliteStore::check_subjects() {
  RELIEVO_TRY_ASSIGN(auto query, database_->prepare("SELECT id, created_at_ms, name, code, name_hash, "
                                                    "code_hash FROM subject WHERE code_hash IS NOT NULL"));
  KeySlots slots(*database_);
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) break;
    RELIEVO_TRY_ASSIGN(const auto subject, subject_in(slots, query));
    RELIEVO_TRY_ASSIGN(const auto code, open_code(*keys_, subject.id, query.blob(3)));
    if (!std::ranges::equal(query.blob(4), keys_->name_hash(subject.name)) ||
        !std::ranges::equal(query.blob(5), keys_->code_hash(code)))
      return Error{Errc::StoreCorrupt, "this person would not be found by name or code: restore a copy"}.at(
          "subject " + std::to_string(query.integer(0)) + ", name_hash or code_hash");
  }
  RELIEVO_TRY_ASSIGN(
      const std::int64_t back,
      database_->integer("SELECT subject.id FROM subject JOIN audit ON subject_id = subject.id AND "
                         "what = 'subject.erased' WHERE code_hash IS NOT NULL"));
  RELIEVO_TRY_ASSIGN(const auto again, erased_and_back(*database_, *keys_));
  if (!again.empty())
    return Error{
        Errc::StoreCorrupt,
        "this person was erased after this copy of the store was made: open it to write, and they are again"}
        .at("subject " + std::to_string(number(again.front())));
  RELIEVO_TRY_ASSIGN(
      const std::int64_t lost,
      database_->integer("SELECT id FROM subject WHERE code_hash IS NULL AND NOT EXISTS (SELECT 1 FROM "
                         "audit WHERE what = 'subject.erased' AND subject_id = subject.id)"));
  if (lost != 0)
    return Error{Errc::StoreCorrupt, "this person has lost their code without an erasure: restore a copy"}.at(
        "subject " + std::to_string(lost));
  RELIEVO_TRY_ASSIGN(const std::int64_t traces, database_->integer("SELECT plain_traces FROM store_info"));
  if (traces != 0)
    return Error{
        Errc::MediaFull,
        "names may still be read in the store's free pages: make room for a second copy, then open it again"}
        .at(database_->where());
  if (back != 0)
    return Error{Errc::StoreCorrupt, "this person was erased, and was put back: erase them again"}.at(
        "subject " + std::to_string(back));
  return {};
}

Result<void> SqliteStore::check_models() {
  RELIEVO_TRY_ASSIGN(auto query,
                     database_->prepare("SELECT enrolment.id FROM enrolment JOIN subject ON subject.id "
                                        "= subject_id WHERE code_hash IS NOT NULL"));
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) return {};
    const EnrolmentId id{query.integer(0)};
    RELIEVO_TRY(enrolment(id));  // its texts, its consent
    RELIEVO_TRY_ASSIGN(const auto bytes, model_bytes(id));
    if (const auto model = decode_model(bytes, std::pmr::new_delete_resource()); !model) {
      return model.error().at("enrolment " + std::to_string(number(id)));
    }
  }
}

}  // namespace relievo::storage
