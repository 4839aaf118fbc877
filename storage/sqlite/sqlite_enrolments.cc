// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore: enrolments and their models.
#include "storage/model_blob.h"
#include "storage/sqlite/sqlite_parts.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kEnrolments =
    "SELECT enrolment.id, subject_id, enrolment.created_at_ms, ifnull(calibration_revision, 0), "
    "enrolment.record, consent.record, length(bytes), "
    "consent.enrolment_id IS NOT NULL AND model.enrolment_id IS NOT NULL "
    "FROM enrolment JOIN subject ON subject.id = subject_id AND code_hash IS NOT NULL "
    "LEFT JOIN consent ON consent.enrolment_id = enrolment.id "
    "LEFT JOIN model ON model.enrolment_id = enrolment.id ";

}  // namespace

Result<void> SqliteStore::check_texts(const NewEnrolment& enrolment) {
  if (!is_name(enrolment.consent.wording) || !is_name(enrolment.consent.language)) {
    return invalid("a consent names its wording and its language");
  }
  if (enrolment.algorithms.size() > kMaxTextBytes || enrolment.report_json.size() > kMaxTextBytes) {
    return invalid("algorithms or report are longer than the store takes");
  }
  return {};
}

Result<Enrolment> SqliteStore::enrolment_in(KeySlots& slots, const Statement& row) {
  Enrolment enrolment;
  enrolment.id = EnrolmentId{row.integer(0)};
  if (row.integer(7) == 0) return half_enrolment(enrolment.id);
  enrolment.subject = SubjectId{row.integer(1)};
  enrolment.created_at = from_ms(row.integer(2));
  enrolment.calibration_revision = std::uint32_t(row.integer(3));
  RELIEVO_TRY(keys_->take_subject_key(slots, enrolment.subject));
  RELIEVO_TRY(open_enrolment(*keys_, enrolment, row.blob(4)));
  RELIEVO_TRY_ASSIGN(enrolment.consent, open_consent(*keys_, enrolment.id, row.blob(5)));
  const auto sealed = std::size_t(row.integer(6));
  enrolment.model_bytes = std::int64_t(SealedStream::plain_bytes(sealed));
  return enrolment;
}

// The subject's key is in keys_ afterwards: what is sealed next is theirs.
Result<SubjectId> SqliteStore::resolve(const SubjectChoice& subject, WallTime at) {
  if (const auto* made = std::get_if<NewSubject>(&subject)) {
    RELIEVO_TRY_ASSIGN(const std::int64_t receipt, fresh_receipt());
    return insert_subject(made->name, receipt, at, at);
  }
  const SubjectId id = std::get<SubjectId>(subject);
  RELIEVO_TRY(subject_must_exist(id));
  return id;
}

Result<EnrolmentId> SqliteStore::insert_enrolment(SubjectId subject, const NewEnrolment& enrolment,
                                                  std::span<const std::byte> blob, WallTime created,
                                                  WallTime at) {
  RELIEVO_TRY(database_->run(
      "INSERT INTO enrolment (subject_id, created_at_ms, calibration_revision) VALUES (?, ?, nullif(?, 0))",
      number(subject), to_ms(created), enrolment.calibration_revision));
  const EnrolmentId id{database_->last_row_id()};
  RELIEVO_TRY(seal_enrolment(*database_, *keys_, id, enrolment.algorithms, enrolment.report_json));
  RELIEVO_TRY(database_->run("INSERT INTO consent (enrolment_id) VALUES (?)", number(id)));
  RELIEVO_TRY(seal_consent(*database_, *keys_, id, enrolment.consent));
  RELIEVO_TRY(seal_model(*database_, *keys_, id, blob));
  RELIEVO_TRY(append_line({std::string(kEnrolmentAdded), subject, std::to_string(number(id))}, at));
  return id;
}

Result<EnrolmentId> SqliteStore::add_enrolment(const SubjectChoice& choice, const NewEnrolment& enrolment,
                                               Subject* owner) {
  return without_exceptions(database_->where(), [&]() -> Result<EnrolmentId> {
    RELIEVO_TRY(check_texts(enrolment));
    RELIEVO_TRY_ASSIGN(const auto blob, encode_model(enrolment.model));
    if (enrolment.renews && mode_ == OpenMode::ReadWrite) RELIEVO_TRY(remove_copies(database_->file()));
    const auto added = change([&](WallTime at) -> Result<EnrolmentId> {
      if (enrolment.calibration_revision != 0) {
        RELIEVO_TRY_ASSIGN(const auto known,
                           database_->integer("SELECT 1 FROM calibration WHERE revision = ?",
                                              enrolment.calibration_revision));
        if (known == 0)
          return not_found("there is no calibration of this revision", enrolment.calibration_revision);
      }
      RELIEVO_TRY_ASSIGN(const SubjectId id, resolve(choice, at));
      if (enrolment.renews) {
        // What is left in any page of the earlier enrolments must be as unreadable as of somebody erased.
        RELIEVO_TRY_ASSIGN(const Subject known, subject(id));
        RELIEVO_TRY(seal_subject(*database_, *keys_, id, known.name, known.receipt));
      }
      RELIEVO_TRY_ASSIGN(const EnrolmentId made, insert_enrolment(id, enrolment, blob, at, at));
      if (enrolment.renews) RELIEVO_TRY(erase_others(id, made, at));
      if (owner != nullptr) {
        RELIEVO_TRY_ASSIGN(*owner, subject(id));
      }
      return made;
    });
    // It is stored, whoever still reads the log: the next change or opening empties that.
    if (added && enrolment.renews) traces_left_ = !empty_the_log(*database_);
    return added;
  });
}

Result<void> SqliteStore::erase_others(SubjectId subject, EnrolmentId but, WallTime at) {
  RELIEVO_TRY(
      database_->run("DELETE FROM enrolment WHERE subject_id = ? AND id <> ?", number(subject), number(but)));
  return append_line({std::string(kEnrolmentRenewed), subject, std::to_string(number(but))}, at);
}

Result<std::vector<Enrolment>> SqliteStore::enrolments(SubjectId subject) {
  return without_exceptions(database_->where(), [&]() -> Result<std::vector<Enrolment>> {
    KeySlots slots(*database_);
    std::vector<Enrolment> found;
    const auto read = [&](const Statement& row) -> Result<void> {
      RELIEVO_TRY_ASSIGN(found.emplace_back(), enrolment_in(slots, row));
      return {};
    };
    RELIEVO_TRY(database_->each(std::string(kEnrolments) + "WHERE subject_id = ? ORDER BY enrolment.id", read,
                                number(subject)));
    return found;
  });
}

Result<Enrolment> SqliteStore::enrolment(EnrolmentId id) {
  return without_exceptions(database_->where(), [&]() -> Result<Enrolment> {
    RELIEVO_TRY_ASSIGN(const auto row,
                       database_->row(std::string(kEnrolments) + "WHERE enrolment.id = ?", number(id)));
    if (!row) return not_found("there is no enrolment with this number", number(id));
    KeySlots slots(*database_);
    return enrolment_in(slots, *row);
  });
}

Result<std::vector<std::byte>> SqliteStore::model_bytes(EnrolmentId id) {
  RELIEVO_TRY_ASSIGN(
      const auto owner,
      database_->integer("SELECT subject.id FROM enrolment JOIN subject ON subject.id = subject_id "
                         "AND code_hash IS NOT NULL WHERE enrolment.id = ?",
                         number(id)));
  if (owner == 0) return not_found("there is no enrolment with this number", number(id));
  KeySlots slots(*database_);
  RELIEVO_TRY(keys_->take_subject_key(slots, SubjectId{owner}));
  return open_model(*database_, *keys_, id);
}

Result<pipeline::FaceModel> SqliteStore::load_model(EnrolmentId id, std::pmr::memory_resource* memory) {
  return without_exceptions(database_->where(), [&]() -> Result<pipeline::FaceModel> {
    RELIEVO_TRY_ASSIGN(const auto bytes, model_bytes(id));
    return decode_model(bytes, memory);
  });
}

}  // namespace relievo::storage
