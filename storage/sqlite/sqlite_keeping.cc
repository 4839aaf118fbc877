// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// SqliteStore as a whole: copies, and its keys.
#include <algorithm>

#include "storage/calibration_record.h"
#include "storage/cipher/recovery.h"
#include "storage/model_blob.h"
#include "storage/sqlite/sqlite_parts.h"

namespace relievo::storage {

Result<bool> SqliteStore::has_recovery_words() {
  RELIEVO_TRY_ASSIGN(const std::int64_t kept,
                     database_->integer("SELECT count(*) FROM encryption_key WHERE kind = 'recovery'"));
  return kept != 0;
}

Result<void> SqliteStore::keep_recovery_words(std::string_view words) {
  return change([&](WallTime at) -> Result<void> {
    RELIEVO_TRY(keys_->keep_recovery_words(*database_, words, at));
    RELIEVO_TRY_ASSIGN(auto trace, StoreKeys::recovery_trace(*database_));
    return append_line({std::string(kRecoveryWordsMade), {}, std::move(trace)}, at);
  });
}

class SqliteKeeping final : public StoreKeeping {
 public:
  SqliteKeeping(std::filesystem::path dir, const hal::Clock& clock, const SqliteStoreOptions& options)
      : dir_(std::move(dir)), clock_(clock), options_(options) {}

  Result<void> backup(const std::filesystem::path& file) override {
    RELIEVO_TRY_ASSIGN(const auto store, open(OpenMode::ReadOnly));
    return without_exceptions(file.native(), [&]() -> Result<void> {
      RELIEVO_TRY(must_be_a_place_for_a_copy(*store, file));
      // Hidden, as every file is until it is whole.
      const auto copied = copy_whole(*store->database_, file,
                                     file.parent_path() / ("." + file.filename().string() + ".part"));
      if (copied || copied.error().code != Errc::MediaFull) return copied;
      return Error{Errc::MediaFull,
                   "the disk is full where the copy goes: make room there, or name another place",
                   copied.error().sys_errno}
          .at(file.native());
    });
  }
  Result<std::vector<SubjectId>> erased_since(const std::filesystem::path& backup) override {
    RELIEVO_TRY_ASSIGN(const auto store, open(OpenMode::ReadOnly));
    return without_exceptions(backup.native(), [&]() -> Result<std::vector<SubjectId>> {
      Database copy(backup);
      const auto end = end_of(copy);
      const Error another = invalid("this is no copy of this store, or a damaged or an older version's one")
                                .at(backup.native());
      if (!end && end.error().code != Errc::StoreCorrupt) return end.error();
      if (!end || !*end) return another;
      RELIEVO_TRY_ASSIGN(const bool same, goes_on_from(*store, **end));
      if (!same) return another;
      std::vector<SubjectId> erased;
      const auto look = [&](const Statement& row) -> Result<void> {
        RELIEVO_TRY_ASSIGN(const std::int64_t in_copy,
                           copy.integer("SELECT 1 FROM subject WHERE id = ?", row.integer(0)));
        if (in_copy != 0) erased.push_back(SubjectId{row.integer(0)});
        return {};
      };
      RELIEVO_TRY(store->database_->each("SELECT subject_id FROM audit WHERE number > ? AND what = ?", look,
                                         (*end)->integer(0), kSubjectErased));
      return erased;
    });
  }
  Result<void> rekey(const KeyPlace& to) override {
    RELIEVO_TRY_ASSIGN(const auto store, open(OpenMode::ReadWrite));
    if (to.sealed_by_tpm) return rekey(*store, *key_file(dir_ / kKeyFile, true, NextKey::SealedByTpm));
    if (!to.file.empty()) {
      // A key of another store that is written over leaves that store to its recovery words.
      SqliteStoreOptions by_it = options_;
      by_it.mode = OpenMode::ReadOnly;
      std::error_code ignored;
      const bool is_new = !std::filesystem::exists(to.file, ignored);
      by_it.keys = key_file(to.file, false, NextKey::Plain, is_new ? dir_ : to.file);
      if (!is_new && !SqliteStore::open(dir_, clock_, by_it))
        return invalid("this file is there, and is not this store's key: name another").at(to.file.native());
      return rekey(*store, *by_it.keys);
    }
    const auto same = options_.keys ? options_.keys : std::shared_ptr<KeySource>(key_file(dir_ / kKeyFile));
    return rekey(*store, *same);
  }
  Result<std::vector<SubjectId>> recover(std::string_view words) override {
    if (auto known = bits_of(words); !known) return known.error();
    SqliteStoreOptions options = options_;
    options.recovery_words = words;
    RELIEVO_TRY(must_be_there(dir_ / kStoreFile));
    Database before(dir_ / kStoreFile);
    RELIEVO_TRY(before.open(false));
    RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(before));
    if (version < 2)  // it has no log either
      return before.error(Errc::NotFound, "no recovery words were ever made for this store");
    if (options_.keys && options_.keys->is_apart()) RELIEVO_TRY(must_not_be_anothers(before));
    RELIEVO_TRY_ASSIGN(const std::int64_t line, before.integer("SELECT max(number) FROM audit"));
    before.close();
    RELIEVO_TRY_ASSIGN(const auto store, SqliteStore::open(dir_, clock_, options));
    RELIEVO_TRY_ASSIGN(const auto log, store->audit(line, -1));
    std::vector<SubjectId> again;
    for (const AuditRecord& one : log)
      if (one.event.what == kSubjectErased) again.push_back(one.event.subject);
    return again;
  }

 private:
  // The last line of a copy's log. None: an older version made it, whose log cannot be compared.
  static Result<std::optional<Statement>> end_of(Database& copy) {
    RELIEVO_TRY(copy.open(false));
    RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(copy));
    if (version < store_version()) return std::optional<Statement>();
    return copy.row("SELECT number, hash FROM audit_end");
  }
  // The copy is this store's, if the log goes on where the copy's ends.
  static Result<bool> goes_on_from(SqliteStore& store, const Statement& end) {
    return ended_so(*store.database_, *store.keys_, end.integer(0), end.blob(1));
  }
  // What a copy replaces is lost for ever: a key, a store that a kiosk is writing to, another store's copy.
  Result<void> must_be_a_place_for_a_copy(SqliteStore& store, const std::filesystem::path& file) const {
    const auto refused = [&](Literal what) { return invalid(what).at(file.native()); };
    std::error_code ignored;
    RELIEVO_TRY(must_lie_outside_stores(file));
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    // This one may have neither lock nor key: never opened to write, its key elsewhere.
    if (std::filesystem::equivalent(folder, dir_, ignored))
      return refused("lies among a store's own files: choose another folder");
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) return {};
    if (!std::filesystem::is_regular_file(file, ignored))
      return refused("this is there, and is no file: name another");
    if (std::filesystem::is_empty(file, ignored)) return {};  // as mktemp makes it
    Database copy(std::filesystem::canonical(file, ignored));
    const auto end = end_of(copy);
    if (!end && end.error().code == Errc::StoreCorrupt)
      return refused("is damaged or no copy: remove it, or name another");
    if (!end && end.error().code != Errc::InvalidInput) return end.error();
    if (end && *end) {
      RELIEVO_TRY_ASSIGN(const bool same, goes_on_from(store, **end));
      if (same) return {};
    }
    return refused(
        "this is there, and is no copy of this store, or an older version's one: remove it, or name another");
  }
  static Result<void> rekey(SqliteStore& store, KeySource& to) {
    RELIEVO_TRY(store.keys_->check_recovery(*store.database_));
    RELIEVO_TRY(remove_copies(store.database_->file()));
    const auto changed = store.change([&](WallTime at) -> Result<void> {
      RELIEVO_TRY(store.keys_->rekey(*store.database_, to, at));
      RELIEVO_TRY_ASSIGN(auto trace, StoreKeys::recovery_trace(*store.database_));
      return store.append_line({std::string(kRekeyed), {}, std::move(trace)}, at);
    });
    if (!changed) return changed;
    RELIEVO_TRY(StoreKeys::finish_change(to));
    return empty_the_log(*store.database_);
  }
  // A new key takes the place of --key's. One that nobody can read (a dead TPM's) is no loss; what is no key
  // its source keeps.
  Result<void> must_not_be_anothers(Database& store) {
    RELIEVO_TRY_ASSIGN(auto key, SecretKey::make());
    if (!options_.keys->read(key)) return {};
    RELIEVO_TRY_ASSIGN(const auto keys, StoreKeys::make(options_.keys));
    const auto opens = keys->load(store, true);
    if (opens || opens.error().code != Errc::InvalidInput) return {};
    return invalid("the file of --key is there, and is not this store's key: name another").at(dir_.native());
  }
  Result<std::unique_ptr<SqliteStore>> open(OpenMode mode) {
    SqliteStoreOptions options = options_;
    options.mode = mode;
    RELIEVO_TRY(must_be_there(dir_ / kStoreFile));  // one that is named wrongly is not made
    return SqliteStore::open(dir_, clock_, options);
  }
  std::filesystem::path dir_;
  const hal::Clock& clock_;
  SqliteStoreOptions options_;
};

std::unique_ptr<StoreKeeping> keep_sqlite_store(const std::filesystem::path& dir, const hal::Clock& clock,
                                                const SqliteStoreOptions& options) {
  return std::make_unique<SqliteKeeping>(dir, clock, options);
}

// SqliteStore: the long check.
Result<void> SqliteStore::check(const std::atomic<bool>& stop) {
  struct Stopping {
    Database& database;
    ~Stopping() { database.stop_at(nullptr); }
  } stopping{*database_};
  database_->stop_at(&stop);
  return without_exceptions(database_->where(), [&]() -> Result<void> {
    RELIEVO_TRY(check_pages());
    RELIEVO_TRY(check_schema(*database_));
    RELIEVO_TRY(check_calibrations());
    RELIEVO_TRY(check_subjects());
    RELIEVO_TRY(check_models());
    RELIEVO_TRY(read_settings(*database_, *keys_));
    return check_audit(*database_, *keys_);
  });
}

Result<void> SqliteStore::check_pages() {
  RELIEVO_TRY_ASSIGN(const auto pages, database_->row("PRAGMA integrity_check(1)"));
  if (!pages || pages->text(0) != "ok") {
    return database_->error(Errc::StoreCorrupt, "the store is damaged: stop using it and restore a copy");
  }
  RELIEVO_TRY_ASSIGN(const auto orphan, database_->row("PRAGMA foreign_key_check"));
  if (orphan)
    return half_enrolment({}).at(std::string(orphan->text(0)) + " " + std::to_string(orphan->integer(1)));
  RELIEVO_TRY_ASSIGN(
      const std::int64_t half,
      database_->integer(
          "SELECT id FROM enrolment WHERE NOT EXISTS (SELECT 1 FROM model WHERE enrolment_id = "
          "enrolment.id) OR NOT EXISTS (SELECT 1 FROM consent WHERE enrolment_id = enrolment.id) LIMIT 1"));
  if (half != 0) return half_enrolment(EnrolmentId{half});
  return {};
}

Result<void> SqliteStore::check_calibrations() {
  RELIEVO_TRY(database_->each("SELECT revision FROM calibration", [&](const Statement& row) -> Result<void> {
    const auto read = calibration(std::uint32_t(row.integer(0)));
    const auto sound = read ? check_calibration(*read) : read.error();
    if (!sound) return sound.error().at("calibration " + std::to_string(row.integer(0)));
    return {};
  }));
  RELIEVO_TRY(calibrations());  // their notes
  return {};
}

Result<void> SqliteStore::check_subjects() {
  KeySlots slots(*database_);
  const auto check_one = [&](const Statement& row) -> Result<void> {
    RELIEVO_TRY(database_->go_on());
    RELIEVO_TRY_ASSIGN(const auto subject, subject_in(slots, row));
    RELIEVO_TRY_ASSIGN(const auto code, open_code(*keys_, subject.id, row.blob(3)));
    if (std::ranges::equal(row.blob(4), keys_->name_hash(subject.name)) &&
        std::ranges::equal(row.blob(5), keys_->code_hash(code)))
      return {};
    return corrupt(subject.id, "this person would not be found by name or code: restore a copy",
                   ", name_hash or code_hash");
  };
  RELIEVO_TRY(
      database_->each("SELECT id, created_at_ms, name, code, name_hash, code_hash FROM subject "
                      "WHERE code_hash IS NOT NULL",
                      check_one));
  RELIEVO_TRY_ASSIGN(
      const std::int64_t back,
      database_->integer("SELECT subject.id FROM subject JOIN audit ON subject_id = subject.id AND "
                         "what = 'subject.erased' WHERE code_hash IS NOT NULL"));
  RELIEVO_TRY_ASSIGN(const auto again, erased_and_back(*database_, *keys_));
  if (!again.empty())
    return corrupt(
        again.front(),
        "this person was erased after this copy of the store was made: start the kiosk on it once, and they are again");
  RELIEVO_TRY_ASSIGN(
      const std::int64_t lost,
      database_->integer("SELECT id FROM subject WHERE code_hash IS NULL AND NOT EXISTS (SELECT 1 FROM "
                         "audit WHERE what = 'subject.erased' AND subject_id = subject.id)"));
  if (lost != 0)
    return corrupt(SubjectId{lost}, "this person has lost their code without an erasure: restore a copy");
  RELIEVO_TRY_ASSIGN(const std::int64_t traces, database_->integer("SELECT plain_traces FROM store_info"));
  if (traces != 0)
    return Error{
        Errc::MediaFull,
        "names may still be read in the store's free pages: make room for a second copy, then open it again"}
        .at(database_->where());
  if (back != 0)
    return corrupt(SubjectId{back}, "this person was erased, and was put back: erase them again");
  return {};
}

Result<void> SqliteStore::check_models() {
  const auto check_one = [&](const Statement& row) -> Result<void> {
    RELIEVO_TRY(database_->go_on());
    const EnrolmentId id{row.integer(0)};
    RELIEVO_TRY(enrolment(id));  // its texts, its consent
    RELIEVO_TRY_ASSIGN(const auto bytes, model_bytes(id));
    const auto model = decode_model(bytes, std::pmr::new_delete_resource());
    return model ? Result<void>() : model.error().at("enrolment " + std::to_string(number(id)));
  };
  return database_->each(
      "SELECT enrolment.id FROM enrolment JOIN subject ON subject.id = subject_id "
      "WHERE code_hash IS NOT NULL",
      check_one);
}

}  // namespace relievo::storage
