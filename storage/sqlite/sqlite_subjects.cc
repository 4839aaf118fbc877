// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SqliteStore: subjects.
#include "storage/calibration_record.h"
#include "storage/model_blob.h"
#include "storage/record.h"
#include "storage/sqlite/sqlite_parts.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

// One without a code is erased, even while its row is there. They are few, and an index has them: so rows
// that are skipped are not read.
constexpr std::string_view kSubjects =
    "SELECT id, created_at_ms, name, code, (SELECT count(*) FROM enrolment WHERE subject_id = subject.id) "
    "FROM subject WHERE id NOT IN (SELECT id FROM subject WHERE code_hash IS NULL) ";

// Without its number, which is this store's own.
Result<std::vector<std::byte>> calibration_of(Database& database, std::uint32_t revision) {
  if (revision == 0) return std::vector<std::byte>();
  RELIEVO_TRY_ASSIGN(auto query,
                     database.prepare("SELECT record FROM calibration WHERE revision = ?", revision));
  RELIEVO_TRY(query.step());
  RELIEVO_TRY_ASSIGN(auto stored, decode_calibration(query.blob(0)));
  stored.calibration.revision = 0;
  return encode_calibration(stored.calibration, stored.figures);
}

}  // namespace

Result<void> SqliteStore::subject_must_exist(SubjectId id) {
  RELIEVO_TRY_ASSIGN(
      const auto known,
      database_->integer("SELECT count(*) FROM subject WHERE code_hash IS NOT NULL AND id = ?", number(id)));
  if (known == 0) return not_found("there is no subject with this number", number(id));
  KeySlots slots(*database_);
  return keys_->take_subject_key(slots, id);
}

Result<Subject> SqliteStore::subject_in(KeySlots& slots, const Statement& row) {
  Subject subject{.id = SubjectId{row.integer(0)}, .name = {}, .created_at = from_ms(row.integer(1))};
  RELIEVO_TRY(keys_->take_subject_key(slots, subject.id));
  RELIEVO_TRY_ASSIGN(subject.name, open_name(*keys_, subject.id, row.blob(2)));
  return subject;
}

// One that nobody has. The index would refuse a second; among a million people one draw in a million meets
// one.
Result<std::int64_t> SqliteStore::fresh_receipt() {
  constexpr int kMostDraws = 100;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    const std::int64_t drawn = draw_receipt_();
    RELIEVO_TRY_ASSIGN(const auto taken, database_->integer("SELECT 1 FROM subject WHERE code_hash = ?",
                                                            keys_->code_hash(drawn)));
    if (taken == 0) return drawn;
  }
  return Error{Errc::LibraryFailed,
               "the system's random numbers repeat themselves: nobody can be given a code"};
}

// `created`: where they came from another store, when they were made there.
Result<SubjectId> SqliteStore::insert_subject(std::string_view name, std::int64_t receipt, WallTime created,
                                              WallTime at) {
  if (!is_name(name)) {
    return invalid("a name has 1 to 200 bytes of UTF-8 and no control characters");
  }
  RELIEVO_TRY(database_->run("INSERT INTO subject (created_at_ms, name) VALUES (?, x'00')", to_ms(created)));
  const SubjectId id{database_->last_row_id()};
  RELIEVO_TRY(seal_subject(*database_, *keys_, id, name, receipt));
  RELIEVO_TRY(append_line({std::string(kSubjectAdded), id, ""}, at));
  return id;
}

Result<SubjectId> SqliteStore::add_subject(const NewSubject& subject) {
  return change([&](WallTime at) { return resolve(subject, at); });
}

Result<std::vector<Subject>> SqliteStore::subjects(const SubjectFilter& filter) {
  return without_exceptions(database_->where(), [&]() -> Result<std::vector<Subject>> {
    const bool by_name = !filter.name.empty(), by_code = filter.receipt != 0;
    RELIEVO_TRY_ASSIGN(
        auto query,
        database_->prepare(std::string(kSubjects) + (by_code ? "AND code_hash = ? " : "") +
                           (by_name ? "AND name_hash = ? " : "") + "ORDER BY id DESC LIMIT -1 OFFSET ?"));
    const auto code_hash = keys_->code_hash(filter.receipt), name_hash = keys_->name_hash(filter.name);
    if (by_code) query.bind(code_hash);
    if (by_name) query.bind(name_hash);
    // Of those skipped nothing has to be read, unless their names say whether they count.
    query.bind(by_name ? 0 : filter.skip);
    KeySlots slots(*database_);
    std::vector<Subject> found;
    for (std::int64_t skip = by_name ? filter.skip : 0; std::int64_t(found.size()) < filter.limit;) {
      RELIEVO_TRY_ASSIGN(const bool row, query.step());
      if (!row) break;
      RELIEVO_TRY_ASSIGN(auto subject, subject_in(slots, query));
      if (by_name && subject.name != filter.name) continue;
      if (skip-- > 0) continue;
      RELIEVO_TRY_ASSIGN(subject.receipt, open_code(*keys_, subject.id, query.blob(3)));
      if (by_code && subject.receipt != filter.receipt)
        return corrupt(subject.id, "a code leads to somebody else's record: restore a copy of the store",
                       ", code_hash");
      subject.enrolments = int(query.integer(4));
      found.push_back(std::move(subject));
    }
    return found;
  });
}

// The index of the codes alone is read.
Result<std::int64_t> SqliteStore::count_subjects() {
  return database_->integer("SELECT count(*) FROM subject WHERE code_hash IS NOT NULL");
}

// The audit log is read from its end, to the first line that will do. People of version 1 have none: of them,
// when they were made.
Result<WallTime> SqliteStore::last_added_at() {
  RELIEVO_TRY_ASSIGN(
      const std::int64_t at_ms,
      database_->integer("SELECT coalesce("
                         "(SELECT at_ms FROM audit WHERE what IN ('subject.added', 'enrolment.added') "
                         "AND EXISTS (SELECT 1 FROM subject WHERE id = audit.subject_id "
                         "AND code_hash IS NOT NULL) ORDER BY number DESC LIMIT 1), "
                         "(SELECT max(created_at_ms) FROM subject WHERE code_hash IS NOT NULL), 0)"));
  return from_ms(at_ms);
}

Result<void> SqliteStore::for_each_subject(Opened opened, const Visit& visit) {
  return without_exceptions(database_->where(), [&]() -> Result<void> {
    RELIEVO_TRY_ASSIGN(
        auto newest,
        database_->prepare("SELECT id, consent.record FROM enrolment JOIN consent ON enrolment_id = id "
                           "WHERE subject_id = ? ORDER BY id DESC LIMIT 1"));
    KeySlots slots(*database_);
    const auto open_one = [&](const Statement& row) -> Result<void> {
      RELIEVO_TRY_ASSIGN(auto subject, subject_in(slots, row));
      if (opened == Opened::Names) return visit(subject, nullptr);
      newest.again();
      RELIEVO_TRY_ASSIGN(const bool agreed, newest.bind(number(subject.id)).step());
      Consent consent;
      if (agreed) {
        RELIEVO_TRY_ASSIGN(consent, open_consent(*keys_, EnrolmentId{newest.integer(0)}, newest.blob(1)));
      }
      return visit(subject, agreed ? &consent : nullptr);
    };
    return database_->each(
        "SELECT id, created_at_ms, name FROM subject WHERE code_hash IS NOT NULL ORDER BY id DESC", open_one);
  });
}

Result<Subject> SqliteStore::subject(SubjectId id) {
  return without_exceptions(database_->where(), [&]() -> Result<Subject> {
    RELIEVO_TRY_ASSIGN(const auto row, database_->row(std::string(kSubjects) + "AND id = ?", number(id)));
    if (!row) return not_found("there is no subject with this number", number(id));
    KeySlots slots(*database_);
    RELIEVO_TRY_ASSIGN(auto subject, subject_in(slots, *row));
    RELIEVO_TRY_ASSIGN(subject.receipt, open_code(*keys_, id, row->blob(3)));
    subject.enrolments = int(row->integer(4));
    return subject;
  });
}

// Two steps: the key, which is small and makes all else unreadable for ever; then the room it took. Where the
// second is cut off, opening the store makes up for it (sqlite_parts.h).
Result<void> SqliteStore::erase_subject(SubjectId id) {
  const Result<void> erased = without_exceptions(database_->where(), [&]() -> Result<void> {
    RELIEVO_TRY(subject_must_exist(id));
    bool remembered = true;
    if (mode_ == OpenMode::ReadWrite) {
      RELIEVO_TRY(remove_copies(database_->file()));
      RELIEVO_TRY_ASSIGN(remembered, remember_erased(*database_, *keys_, id));
    }
    const auto destroyed =
        change_in_reserve([&](WallTime at) { return destroy_subject_key(*database_, *keys_, id, at); });
    if (!destroyed) return destroyed;
    (void)empty_the_log(*database_);  // where a reader is in the way, the last one below says so
    const auto removed = change_in_reserve([&](WallTime) { return remove_erased_rows(*database_); });
    if (!removed)
      return Error{removed.error().code,
                   "erased; the room it took is not free yet: close the store and open it again",
                   removed.error().sys_errno}
          .at(database_->where());
    RELIEVO_TRY(empty_the_log(*database_));
    if (remembered) return {};
    return Error{Errc::IoFailed,
                 "erased; but relievo.erased beside it could not be written, and an older copy of the store "
                 "would bring this person back: check that file and its owner"}
        .at(database_->where());
  });
  if (mode_ == OpenMode::ReadWrite) set_aside_reserve(home_, reserve_bytes_);
  return erased;
}

// SqliteStore: people who go from one store to another.
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
    return invalid("this person's code is none that a store gives");
  RELIEVO_TRY_ASSIGN(
      const std::int64_t theirs,
      database_->integer("SELECT id FROM subject WHERE code_hash = ?", keys_->code_hash(receipt)));
  // First: the list of the erased also has whom an erasure that failed left here.
  if (theirs != 0)
    return invalid("somebody with this person's code is in the store: nothing was changed")
        .at("subject " + std::to_string(theirs));
  RELIEVO_TRY_ASSIGN(const bool erased, was_erased(*database_, *keys_, receipt));
  if (!erased) return {};
  return invalid("this person was erased from this store after the copy was made: it brings nobody back");
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
    RELIEVO_TRY(append_line({"subject.taken_in", id, ""}, at));
    return id;
  });
}

}  // namespace relievo::storage
