// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore: the long check.
#include "storage/calibration_record.h"
#include "storage/model_blob.h"
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"

namespace relievo::storage {

Result<void> SqliteStore::check() {
  return without_exceptions(database_->where(), [&]() -> Result<void> {
    RELIEVO_TRY(check_pages());
    RELIEVO_TRY(check_calibrations());
    RELIEVO_TRY(check_models());
    return check_audit_chain(*database_);
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
    if (!row) return {};
    RELIEVO_TRY_ASSIGN(const auto read, calibration(static_cast<std::uint32_t>(query.integer(0))));
    RELIEVO_TRY(check_calibration(read));
  }
}

Result<void> SqliteStore::check_models() {
  RELIEVO_TRY_ASSIGN(auto query, database_->prepare("SELECT enrolment_id FROM model"));
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) return {};
    const EnrolmentId id{query.integer(0)};
    RELIEVO_TRY_ASSIGN(const auto bytes, model_bytes(id));
    if (const auto model = decode_model(bytes, std::pmr::new_delete_resource()); !model) {
      return model.error().at("enrolment " + std::to_string(number(id)));
    }
  }
}

}  // namespace relievo::storage
