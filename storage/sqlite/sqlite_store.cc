// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_store.h"

#include <system_error>

#include "storage/sqlite/sqlite_parts.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;

Result<void> set_up(Database& database, const SqliteStoreOptions& options) {
  const std::string wait = "PRAGMA busy_timeout = " + std::to_string(options.wait_for_lock.count());
  RELIEVO_TRY(database.run(wait.c_str()));
  return database.run(
      "PRAGMA cell_size_check = ON; PRAGMA foreign_keys = ON; PRAGMA secure_delete = ON;"
      "PRAGMA temp_store = MEMORY; PRAGMA mmap_size = 0;");
}

Result<void> set_up_writing(Database& database, const SqliteStoreOptions& options) {
  RELIEVO_TRY_ASSIGN(auto mode, database.prepare("PRAGMA journal_mode = WAL"));
  RELIEVO_TRY_ASSIGN(const bool row, mode.step());
  if (!row || mode.text(0) != "wal") {
    return database.error(Errc::Unsupported, "this disk cannot hold the store's log: use a local disk");
  }
  RELIEVO_TRY(mode.run());
  // The log is moved into the file after every enrolment: on a full disk little is then left in it.
  RELIEVO_TRY(database.run(
      "PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 100; PRAGMA journal_size_limit = 4194304"));
  if (options.max_bytes > 0) {
    RELIEVO_TRY_ASSIGN(const std::int64_t page, database.integer("PRAGMA page_size"));
    const std::string limit = "PRAGMA max_page_count = " + std::to_string(options.max_bytes / page);
    RELIEVO_TRY(database.run(limit.c_str()));
  }
  return {};
}

// An older copy was put in the store's place: who was erased since is erased again.
Result<void> erase_again(Database& database, StoreKeys& keys, WallTime at) {
  RELIEVO_TRY_ASSIGN(const auto back, erased_and_back(database, keys));
  if (back.empty()) return {};
  Transaction transaction(database);
  RELIEVO_TRY(transaction.begin());
  for (const SubjectId id : back) RELIEVO_TRY(destroy_subject_key(database, keys, id, at));
  return transaction.commit();
}

Result<void> recover(Database& database, StoreKeys& keys, WallTime at, const SqliteStoreOptions& options) {
  Transaction transaction(database);
  RELIEVO_TRY(transaction.begin());
  RELIEVO_TRY(keys.recover(database, options.recovery_words, *options.keys, at));
  RELIEVO_TRY(transaction.commit());
  return StoreKeys::finish_change(*options.keys);
}

Result<void> open_to_write(Database& database, StoreKeys& keys, WallTime at,
                           const SqliteStoreOptions& options) {
  RELIEVO_TRY(make_private_file(database.file()));
  RELIEVO_TRY(database.open(true));
  RELIEVO_TRY(set_up(database, options));
  RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(database));
  RELIEVO_TRY(set_up_writing(database, options));
  RELIEVO_TRY(database.tidy_up_on_close(true));
  if (!options.recovery_words.empty()) RELIEVO_TRY(recover(database, keys, at, options));
  RELIEVO_TRY(make_current(database, version, keys, at));
  // Power may have gone in the middle of an erasure, or of the migration that sealed an older store.
  RELIEVO_TRY(erase_again(database, keys, at));
  RELIEVO_TRY(remove_erased_rows(database));
  RELIEVO_TRY(remove_copies(database.file(), kAllSealed));
  RELIEVO_TRY(remove_plain_traces(database));
  RELIEVO_TRY(database.empty_log());
  return {};
}

// The same, where nothing may be changed: no verb sees them. A view of this connection alone takes the
// table's name, so that none that reads people can forget it.
Result<void> hide_erased(Database& database, const StoreKeys& keys) {
  RELIEVO_TRY_ASSIGN(const auto back, erased_and_back(database, keys));
  if (back.empty()) return {};
  RELIEVO_TRY(database.run("CREATE TEMP TABLE back (id INTEGER PRIMARY KEY)"));
  for (const SubjectId id : back) RELIEVO_TRY(database.run("INSERT INTO back (id) VALUES (?)", number(id)));
  return database.run(
      "CREATE TEMP VIEW subject AS SELECT * FROM main.subject WHERE id NOT IN (SELECT id FROM back)");
}

Result<void> open_to_read(Database& database, StoreKeys& keys, const SqliteStoreOptions& options) {
  RELIEVO_TRY(must_be_there(database.file()));
  RELIEVO_TRY(database.open(false));
  RELIEVO_TRY(set_up(database, options));
  const Result<std::int64_t> version = version_of(database);
  if (!version && version.error().code == Errc::IoFailed)
    RELIEVO_TRY(must_take_files(database.file().parent_path()));
  if (!version) return version.error();
  if (*version < store_version()) {
    return database.error(Errc::InvalidState, "the store is of an older version: start the kiosk on it once");
  }
  RELIEVO_TRY(keys.load(database, true));
  return hide_erased(database, keys);
}

WallTime time_of(const hal::Clock& clock) {
  return std::chrono::time_point_cast<std::chrono::milliseconds>(clock.wall_now());
}

}  // namespace

WallTime SqliteStore::now() const { return time_of(clock_); }

Error SqliteStore::not_found(Literal what, std::int64_t number) const {
  return Error{Errc::NotFound, what}.at(std::to_string(number));
}

Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const fs::path& dir, const hal::Clock& clock,
                                                       const SqliteStoreOptions& given) {
  return without_exceptions(dir.native(), [&]() -> Result<std::unique_ptr<SqliteStore>> {
    SqliteStoreOptions options = given;
    const bool writable = options.mode == OpenMode::ReadWrite;
    std::error_code failed;
    if (writable) RELIEVO_TRY(make_store_directory(fs::absolute(dir, failed)));
    RELIEVO_TRY_ASSIGN(const fs::path home, home_of(dir));
    if (!options.keys) options.keys = key_file(home / kKeyFile);
    auto lock = std::make_unique<StoreLock>();
    if (writable) RELIEVO_TRY(lock->take(home / kLockFile, options.wait_for_lock));
    auto database = std::make_unique<Database>(home / kStoreFile);
    RELIEVO_TRY_ASSIGN(auto keys, StoreKeys::make(options.keys));
    const WallTime at = time_of(clock);
    auto ready =
        writable ? open_to_write(*database, *keys, at, options) : open_to_read(*database, *keys, options);
    if (writable && !ready && ready.error().code == Errc::MediaFull && give_up_reserve(home)) {
      database = std::make_unique<Database>(home / kStoreFile);
      ready = open_to_write(*database, *keys, at, options);
    }
    if (!ready) return ready.error();
    if (writable) set_aside_reserve(home, options.reserve_bytes);
    return std::make_unique<SqliteStore>(std::move(lock), std::move(database), std::move(keys), clock,
                                         options);
  });
}

Result<std::unique_ptr<Store>> open_sqlite_store(const fs::path& dir, const hal::Clock& clock,
                                                 const SqliteStoreOptions& options) {
  RELIEVO_TRY_ASSIGN(auto store, SqliteStore::open(dir, clock, options));
  return std::unique_ptr<Store>(std::move(store));
}

}  // namespace relievo::storage
