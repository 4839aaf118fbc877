// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_sealing.h"

#include "storage/byte_order.h"
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_sealed_rows.h"
#include "storage/sqlite/sqlite_settings.h"

namespace relievo::storage {
namespace {

// Of one transaction: the log grows by as much.
constexpr int kMostPeople = 200;
constexpr std::size_t kMostBytes = 64'000'000;

Result<std::size_t> seal_plain_model(Database& database, StoreKeys& keys, EnrolmentId id) {
  std::vector<std::byte> plain;
  {
    RELIEVO_TRY_ASSIGN(auto source, Blob::open(database, "model", "bytes", number(id), false));
    plain.resize(source.size());
    RELIEVO_TRY(source.read(0, plain));
  }
  RELIEVO_TRY(seal_model(database, keys, id, plain));
  // The plain one is about to go for good.
  RELIEVO_TRY_ASSIGN(const auto back, open_model(database, keys, id));
  if (back != plain)
    return Error{Errc::StoreCorrupt, "a model did not come back as it was sealed: check memory and disk"}.at(
        database.where());
  return plain.size();
}

Result<std::size_t> seal_person(Database& database, StoreKeys& keys, SubjectId id) {
  RELIEVO_TRY_ASSIGN(
      auto query,
      database.prepare("SELECT enrolment.id, algorithms, report_json, wording, language, given_at_ms "
                       "FROM enrolment JOIN consent ON enrolment_id = enrolment.id "
                       "WHERE subject_id = ? AND enrolment.record IS NULL ORDER BY enrolment.id"));
  query.bind(number(id));
  std::size_t bytes = 0;
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) return bytes;
    const EnrolmentId enrolment{query.integer(0)};
    const Consent consent{std::string(query.text(3)), std::string(query.text(4)), from_ms(query.integer(5))};
    RELIEVO_TRY(seal_enrolment(database, keys, enrolment, query.text(1), query.text(2)));
    RELIEVO_TRY(seal_consent(database, keys, enrolment, consent));
    RELIEVO_TRY_ASSIGN(const std::size_t model, seal_plain_model(database, keys, enrolment));
    bytes += model;
  }
}

// false: nobody is left.
Result<bool> seal_some_people(Database& database, StoreKeys& keys) {
  Transaction transaction(database);
  RELIEVO_TRY(transaction.begin());
  std::size_t bytes = 0;
  for (int people = 0; people < kMostPeople && bytes < kMostBytes; ++people) {
    SubjectId id{};
    {
      RELIEVO_TRY_ASSIGN(auto query,
                         database.prepare("SELECT id, name, receipt FROM subject WHERE code_hash IS "
                                          "NULL AND key_id IS NULL ORDER BY id LIMIT 1"));
      RELIEVO_TRY_ASSIGN(const bool row, query.step());
      if (!row) {
        RELIEVO_TRY(transaction.commit());
        return false;
      }
      id = SubjectId{query.integer(0)};
      const auto name = query.blob(1);
      const std::string kept(reinterpret_cast<const char*>(name.data()), name.size());
      RELIEVO_TRY(seal_subject(database, keys, id, kept, query.integer(2)));
    }
    RELIEVO_TRY_ASSIGN(const std::size_t models, seal_person(database, keys, id));
    bytes += models;
  }
  RELIEVO_TRY(transaction.commit());
  return true;
}

Result<void> seal_notes(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(auto query, database.prepare("SELECT revision, note FROM calibration"));
  RELIEVO_TRY_ASSIGN(
      auto update, database.prepare("UPDATE calibration SET sealed_note = ?, note = '' WHERE revision = ?"));
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) return {};
    const std::int64_t revision = query.integer(0);
    const auto sealed = seal(keys.device(), calibration_note(revision), bytes_of(query.text(1)));
    update.again();
    RELIEVO_TRY(update.bind(sealed).bind(revision).run());
  }
}

Result<void> seal_settings(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(auto query, database.prepare("SELECT key, value FROM setting"));
  Settings settings;
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool row, query.step());
    if (!row) break;
    settings.insert_or_assign(std::string(query.text(0)), std::string(query.text(1)));
  }
  RELIEVO_TRY_ASSIGN(const std::int64_t line, last_setting_line(database));
  return write_settings(database, keys, settings, line);
}

}  // namespace

Result<void> seal_people(Database& database, StoreKeys& keys) {
  for (;;) {
    RELIEVO_TRY_ASSIGN(const bool more, seal_some_people(database, keys));
    if (!more) return {};
  }
}

Result<void> seal_the_rest(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY(database.run("UPDATE store_info SET plain_traces = 1"));
  RELIEVO_TRY(seal_notes(database, keys));
  RELIEVO_TRY(seal_settings(database, keys));
  return seal_audit(database, keys);
}

Result<void> remove_plain_traces(Database& database) {
  RELIEVO_TRY_ASSIGN(const std::int64_t traces, database.integer("SELECT plain_traces FROM store_info"));
  if (traces == 0) return {};
  // A new copy of all that is there, and of nothing else, takes the file's place. It would not fit into
  // memory.
  const auto copied = database.run("PRAGMA temp_store = FILE; VACUUM");
  RELIEVO_TRY(database.run("PRAGMA temp_store = MEMORY"));
  if (!copied) return copied.error().code == Errc::MediaFull ? Result<void>() : copied;
  return database.run("UPDATE store_info SET plain_traces = 0");
}

}  // namespace relievo::storage
