// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
// SqliteStore as a whole: copies, and its keys.
#include <algorithm>

#include "storage/cipher/recovery.h"
#include "storage/sqlite/sqlite_audit.h"
#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_erasure.h"
#include "storage/sqlite/sqlite_migration.h"

namespace relievo::storage {

Result<void> SqliteStore::backup(const std::filesystem::path& file) {
  return without_exceptions(file.native(), [&] { return copy_whole(*database_, file); });
}

Result<std::vector<SubjectId>> SqliteStore::erased_since(const std::filesystem::path& backup) {
  return without_exceptions(backup.native(), [&]() -> Result<std::vector<SubjectId>> {
    Database copy(backup);
    RELIEVO_TRY(copy.open(false));
    RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(copy));
    const Error another =
        Error{Errc::InvalidInput, "this is no copy of this store, or one of before it was sealed"}.at(
            backup.native());
    if (version < store_version()) return another;
    RELIEVO_TRY_ASSIGN(auto end, copy.prepare("SELECT number, hash FROM audit_end"));
    RELIEVO_TRY_ASSIGN(const bool ended, end.step());
    if (!ended) return another;
    // The same store, if its log goes on where the copy's ends.
    RELIEVO_TRY_ASSIGN(auto same, database_->prepare("SELECT hash FROM audit WHERE number = ?"));
    RELIEVO_TRY_ASSIGN(const bool known, same.bind(end.integer(0)).step());
    if (!known || !std::ranges::equal(same.blob(0), end.blob(1))) return another;
    RELIEVO_TRY_ASSIGN(auto query,
                       database_->prepare("SELECT subject_id FROM audit WHERE number > ? AND what = ?"));
    query.bind(end.integer(0)).bind(kSubjectErased);
    RELIEVO_TRY_ASSIGN(auto there, copy.prepare("SELECT 1 FROM subject WHERE id = ?"));
    std::vector<SubjectId> erased;
    for (;;) {
      RELIEVO_TRY_ASSIGN(const bool row, query.step());
      if (!row) return erased;
      there.again();
      RELIEVO_TRY_ASSIGN(const bool in_copy, there.bind(query.integer(0)).step());
      if (in_copy) erased.push_back(SubjectId{query.integer(0)});
    }
  });
}

Result<void> SqliteStore::rekey(KeySource& to) {
  RELIEVO_TRY(remove_old_copies(database_->file()));
  const auto changed = change([&](WallTime at) -> Result<void> {
    RELIEVO_TRY(keys_->rekey(*database_, to, at));
    RELIEVO_TRY(append_audit_line(*database_, *keys_, {"store.rekeyed", {}, ""}, at));
    return {};
  });
  if (!changed) return changed;
  RELIEVO_TRY(StoreKeys::finish_change(to));
  return empty_the_log(*database_);
}

Result<bool> SqliteStore::has_recovery_words() {
  RELIEVO_TRY_ASSIGN(const std::int64_t kept,
                     database_->integer("SELECT count(*) FROM encryption_key WHERE kind = 'recovery'"));
  return kept != 0;
}

Result<void> SqliteStore::keep_recovery_words(std::string_view words) {
  return change([&](WallTime at) -> Result<void> {
    RELIEVO_TRY(keys_->keep_recovery_words(*database_, words, at));
    RELIEVO_TRY(append_audit_line(*database_, *keys_, {"store.recovery_words", {}, ""}, at));
    return {};
  });
}

namespace {

class SqliteKeeping final : public StoreKeeping {
 public:
  SqliteKeeping(std::filesystem::path dir, const hal::Clock& clock, const SqliteStoreOptions& options)
      : dir_(std::move(dir)), clock_(clock), options_(options) {}

  Result<void> backup(const std::filesystem::path& file) override {
    RELIEVO_TRY_ASSIGN(const auto store, open(OpenMode::ReadOnly));
    return store->backup(file);
  }
  Result<std::vector<SubjectId>> erased_since(const std::filesystem::path& backup) override {
    RELIEVO_TRY_ASSIGN(const auto store, open(OpenMode::ReadOnly));
    return store->erased_since(backup);
  }
  Result<void> rekey(const KeyPlace& to) override {
    RELIEVO_TRY_ASSIGN(const auto store, open(OpenMode::ReadWrite));
    if (to.sealed_by_tpm) return store->rekey(*key_file(dir_ / kKeyFile, true, NextKey::SealedByTpm));
    if (!to.file.empty()) return store->rekey(*key_file(to.file, false));
    const auto same = options_.keys ? options_.keys : std::shared_ptr<KeySource>(key_file(dir_ / kKeyFile));
    return store->rekey(*same);
  }
  Result<std::vector<SubjectId>> recover(std::string_view words) override {
    if (auto known = bits_of(words); !known) return known.error();
    SqliteStoreOptions options = options_;
    options.recovery_words = words;
    RELIEVO_TRY(must_exist());
    Database before(dir_ / kStoreFile);
    RELIEVO_TRY(before.open(false));
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
  // A store that is named wrongly is not made.
  Result<void> must_exist() const {
    std::error_code ignored;
    if (std::filesystem::exists(dir_ / kStoreFile, ignored)) return {};
    return Error{Errc::NotFound, "there is no store: check the path"}.at(dir_.native());
  }
  Result<std::unique_ptr<SqliteStore>> open(OpenMode mode) {
    SqliteStoreOptions options = options_;
    options.mode = mode;
    RELIEVO_TRY(must_exist());
    return SqliteStore::open(dir_, clock_, options);
  }
  std::filesystem::path dir_;
  const hal::Clock& clock_;
  SqliteStoreOptions options_;
};

}  // namespace

std::unique_ptr<StoreKeeping> keep_sqlite_store(const std::filesystem::path& dir, const hal::Clock& clock,
                                                const SqliteStoreOptions& options) {
  return std::make_unique<SqliteKeeping>(dir, clock, options);
}

}  // namespace relievo::storage
