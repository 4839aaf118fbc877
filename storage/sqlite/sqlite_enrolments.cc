// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore: enrolments and their models.
#include "storage/model_blob.h"
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_migration.h"
#include "storage/sqlite/store_directory.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kEnrolments =
    "SELECT enrolment.id, subject_id, created_at_ms, wording, language, given_at_ms, "
    "ifnull(calibration_revision, 0), algorithms, report_json, length(bytes) "
    "FROM enrolment JOIN consent ON consent.enrolment_id = enrolment.id "
    "JOIN model ON model.enrolment_id = enrolment.id ";

Enrolment enrolment_in(const Statement& query) {
  return {.id = EnrolmentId{query.integer(0)},
          .subject = SubjectId{query.integer(1)},
          .created_at = from_ms(query.integer(2)),
          .consent = {std::string(query.text(3)), std::string(query.text(4)), from_ms(query.integer(5))},
          .calibration_revision = static_cast<std::uint32_t>(query.integer(6)),
          .algorithms = std::string(query.text(7)),
          .report_json = std::string(query.text(8)),
          .model_bytes = query.integer(9)};
}

Result<void> check_texts(const NewEnrolment& enrolment) {
  if (!is_name(enrolment.consent.wording) || !is_name(enrolment.consent.language)) {
    return Error{Errc::InvalidInput, "a consent names its wording and its language"};
  }
  if (enrolment.algorithms.size() > kMaxTextBytes || enrolment.report_json.size() > kMaxTextBytes) {
    return Error{Errc::InvalidInput, "algorithms or report are longer than the store takes"};
  }
  return {};
}

}  // namespace

Result<SubjectId> SqliteStore::resolve(const SubjectChoice& subject, WallTime at) {
  if (const auto* made = std::get_if<NewSubject>(&subject)) return insert_subject(*made, at);
  const SubjectId id = std::get<SubjectId>(subject);
  RELIEVO_TRY(subject_must_exist(id));
  return id;
}

Result<EnrolmentId> SqliteStore::insert_enrolment(SubjectId subject, const NewEnrolment& enrolment,
                                                  std::span<const std::byte> blob, WallTime at) {
  RELIEVO_TRY_ASSIGN(
      auto row, database_->prepare("INSERT INTO enrolment (subject_id, created_at_ms, calibration_revision, "
                                   "algorithms, report_json) VALUES (?, ?, ?, ?, ?)"));
  row.bind(number(subject)).bind(to_ms(at));
  if (enrolment.calibration_revision == 0) row.bind_null();
  else row.bind(std::int64_t{enrolment.calibration_revision});
  RELIEVO_TRY(row.bind(enrolment.algorithms).bind(enrolment.report_json).run());
  const EnrolmentId id{database_->last_row_id()};

  RELIEVO_TRY_ASSIGN(auto consent,
                     database_->prepare("INSERT INTO consent (enrolment_id, wording, language, given_at_ms) "
                                        "VALUES (?, ?, ?, ?)"));
  consent.bind(number(id)).bind(enrolment.consent.wording).bind(enrolment.consent.language);
  RELIEVO_TRY(consent.bind(to_ms(enrolment.consent.given_at)).run());

  RELIEVO_TRY_ASSIGN(auto model, database_->prepare("INSERT INTO model (enrolment_id, bytes) VALUES (?, ?)"));
  RELIEVO_TRY(model.bind(number(id)).bind_zeros(static_cast<std::int64_t>(blob.size())).run());
  RELIEVO_TRY(database_->write_blob("model", "bytes", number(id), blob));
  RELIEVO_TRY(append_audit_line(*database_, {"enrolment.added", subject, std::to_string(number(id))}, at));
  return id;
}

Result<EnrolmentId> SqliteStore::add_enrolment(const SubjectChoice& subject, const NewEnrolment& enrolment) {
  return without_exceptions(database_->where(), [&]() -> Result<EnrolmentId> {
    RELIEVO_TRY(check_texts(enrolment));
    RELIEVO_TRY_ASSIGN(const auto blob, encode_model(enrolment.model));
    if (enrolment.renews && mode_ == OpenMode::ReadWrite) RELIEVO_TRY(remove_old_copies(database_->file()));
    const auto added = change([&](WallTime at) -> Result<EnrolmentId> {
      if (enrolment.calibration_revision != 0) {
        RELIEVO_TRY_ASSIGN(auto known, database_->prepare("SELECT 1 FROM calibration WHERE revision = ?"));
        RELIEVO_TRY_ASSIGN(const bool row, known.bind(std::int64_t{enrolment.calibration_revision}).step());
        if (!row)
          return not_found("there is no calibration of this revision", enrolment.calibration_revision);
      }
      RELIEVO_TRY_ASSIGN(const SubjectId id, resolve(subject, at));
      RELIEVO_TRY_ASSIGN(const EnrolmentId made, insert_enrolment(id, enrolment, blob, at));
      if (enrolment.renews) RELIEVO_TRY(erase_others(id, made, at));
      return made;
    });
    if (added && enrolment.renews) RELIEVO_TRY(empty_the_log());
    return added;
  });
}

Result<void> SqliteStore::erase_others(SubjectId subject, EnrolmentId but, WallTime at) {
  RELIEVO_TRY_ASSIGN(auto erase,
                     database_->prepare("DELETE FROM enrolment WHERE subject_id = ? AND id <> ?"));
  RELIEVO_TRY(erase.bind(number(subject)).bind(number(but)).run());
  return append_audit_line(*database_, {"enrolment.renewed", subject, std::to_string(number(but))}, at);
}

Result<std::vector<Enrolment>> SqliteStore::enrolments(SubjectId subject) {
  return without_exceptions(database_->where(), [&]() -> Result<std::vector<Enrolment>> {
    RELIEVO_TRY_ASSIGN(auto query, database_->prepare(std::string(kEnrolments) +
                                                      "WHERE subject_id = ? ORDER BY enrolment.id"));
    query.bind(number(subject));
    std::vector<Enrolment> found;
    for (;;) {
      RELIEVO_TRY_ASSIGN(const bool row, query.step());
      if (!row) return found;
      found.push_back(enrolment_in(query));
    }
  });
}

Result<Enrolment> SqliteStore::enrolment(EnrolmentId id) {
  return without_exceptions(database_->where(), [&]() -> Result<Enrolment> {
    RELIEVO_TRY_ASSIGN(auto query, database_->prepare(std::string(kEnrolments) + "WHERE enrolment.id = ?"));
    RELIEVO_TRY_ASSIGN(const bool row, query.bind(number(id)).step());
    if (!row) return not_found("there is no enrolment with this number", number(id));
    return enrolment_in(query);
  });
}

Result<std::vector<std::byte>> SqliteStore::model_bytes(EnrolmentId id) {
  RELIEVO_TRY_ASSIGN(auto query,
                     database_->prepare("SELECT length(bytes) FROM model WHERE enrolment_id = ?"));
  RELIEVO_TRY_ASSIGN(const bool row, query.bind(number(id)).step());
  if (!row) return not_found("there is no enrolment with this number", number(id));
  // SQLite refuses lengths past SQLITE_MAX_LENGTH (1 GB), whatever the file says.
  std::vector<std::byte> bytes(static_cast<std::size_t>(query.integer(0)));
  RELIEVO_TRY(database_->read_blob("model", "bytes", number(id), bytes));
  return bytes;
}

Result<pipeline::FaceModel> SqliteStore::load_model(EnrolmentId id, std::pmr::memory_resource* memory) {
  return without_exceptions(database_->where(), [&]() -> Result<pipeline::FaceModel> {
    RELIEVO_TRY_ASSIGN(const auto bytes, model_bytes(id));
    return decode_model(bytes, memory);
  });
}

}  // namespace relievo::storage
