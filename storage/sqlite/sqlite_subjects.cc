// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore: subjects.
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_migration.h"
#include "storage/sqlite/store_directory.h"
#include "storage/text.h"

namespace relievo::storage {
namespace {

constexpr std::string_view kSubjects =
    "SELECT id, name, created_at_ms, (SELECT count(*) FROM enrolment WHERE subject_id = subject.id), "
    "receipt FROM subject ";

std::string_view name_in(const Statement& query) {
  const auto bytes = query.blob(1);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Subject subject_in(const Statement& query) {
  return {SubjectId{query.integer(0)}, std::string(name_in(query)), from_ms(query.integer(2)),
          static_cast<int>(query.integer(3)), query.integer(4)};
}

}  // namespace

Result<void> SqliteStore::subject_must_exist(SubjectId id) {
  RELIEVO_TRY_ASSIGN(auto query, database_->prepare("SELECT 1 FROM subject WHERE id = ?"));
  RELIEVO_TRY_ASSIGN(const bool row, query.bind(number(id)).step());
  return row ? Result<void>() : not_found("there is no subject with this number", number(id));
}

// One that nobody has. The index would refuse a second; among a million people one draw in a million meets
// one.
Result<std::int64_t> SqliteStore::fresh_receipt() {
  constexpr int kMostDraws = 100;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    const std::int64_t drawn = draw_receipt_();
    RELIEVO_TRY_ASSIGN(auto query, database_->prepare("SELECT 1 FROM subject WHERE receipt = ?"));
    RELIEVO_TRY_ASSIGN(const bool taken, query.bind(drawn).step());
    if (!taken) return drawn;
  }
  return Error{Errc::LibraryFailed,
               "the system's random numbers repeat themselves: nobody can be given a code"};
}

Result<SubjectId> SqliteStore::insert_subject(const NewSubject& subject, WallTime at) {
  if (!is_name(subject.name)) {
    return Error{Errc::InvalidInput, "a name has 1 to 200 bytes of UTF-8 and no control characters"};
  }
  RELIEVO_TRY_ASSIGN(
      auto insert, database_->prepare("INSERT INTO subject (created_at_ms, name, receipt) VALUES (?, ?, ?)"));
  RELIEVO_TRY_ASSIGN(const std::int64_t receipt, fresh_receipt());
  RELIEVO_TRY(insert.bind(to_ms(at)).bind(std::as_bytes(std::span(subject.name))).bind(receipt).run());
  const SubjectId id{database_->last_row_id()};
  RELIEVO_TRY(append_audit_line(*database_, {"subject.added", id, ""}, at));
  return id;
}

Result<SubjectId> SqliteStore::add_subject(const NewSubject& subject) {
  return change([&](WallTime at) { return insert_subject(subject, at); });
}

Result<std::vector<Subject>> SqliteStore::subjects(const SubjectFilter& filter) {
  return without_exceptions(database_->where(), [&]() -> Result<std::vector<Subject>> {
    RELIEVO_TRY_ASSIGN(auto query, database_->prepare(std::string(kSubjects) +
                                                      "WHERE ?1 = 0 OR receipt = ?1 ORDER BY id DESC"));
    query.bind(filter.receipt);
    std::vector<Subject> found;
    // Names are compared here, not in SQL: there they will be cipher text.
    for (std::int64_t skip = filter.skip; static_cast<std::int64_t>(found.size()) < filter.limit;) {
      RELIEVO_TRY_ASSIGN(const bool row, query.step());
      if (!row) break;
      const auto name = name_in(query);
      if (filter.whole_name && !filter.name.empty() ? name != filter.name : !contains_name(name, filter.name))
        continue;
      if (skip-- <= 0) found.push_back(subject_in(query));
    }
    return found;
  });
}

Result<Subject> SqliteStore::subject(SubjectId id) {
  return without_exceptions(database_->where(), [&]() -> Result<Subject> {
    RELIEVO_TRY_ASSIGN(auto query, database_->prepare(std::string(kSubjects) + "WHERE id = ?"));
    RELIEVO_TRY_ASSIGN(const bool row, query.bind(number(id)).step());
    if (!row) return not_found("there is no subject with this number", number(id));
    return subject_in(query);
  });
}

Result<void> SqliteStore::erase_subject(SubjectId id) {
  return without_exceptions(database_->where(), [&]() -> Result<void> {
    RELIEVO_TRY(subject_must_exist(id));
    if (mode_ == OpenMode::ReadWrite) RELIEVO_TRY(remove_old_copies(database_->file()));
    const auto erase = [&](WallTime at) -> Result<void> {
      RELIEVO_TRY_ASSIGN(auto statement, database_->prepare("DELETE FROM subject WHERE id = ?"));
      RELIEVO_TRY(statement.bind(number(id)).run());
      return append_audit_line(*database_, {"subject.erased", id, ""}, at);
    };
    auto erased = change(erase);
    // The way out of a full disk may not itself end there.
    if (!erased && erased.error().code == Errc::MediaFull &&
        give_up_reserve(database_->file().parent_path())) {
      erased = change(erase);
    }
    if (!erased) return erased;
    return empty_the_log();
  });
}

// The log still holds the pages as they were: move it into the file, and empty it.
Result<void> SqliteStore::empty_the_log() {
  RELIEVO_TRY_ASSIGN(const std::int64_t busy, database_->integer("PRAGMA wal_checkpoint(TRUNCATE)"));
  if (busy == 0) return {};
  return Error{Errc::Timeout, "erased, but another program keeps traces in the log: close it, then restart"}
      .at(database_->where());
}

}  // namespace relievo::storage
