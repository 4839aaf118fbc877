// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_store.h"

#include <system_error>

#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_erasure.h"
#include "storage/sqlite/sqlite_migration.h"
#include "storage/sqlite/sqlite_sealing.h"
#include "storage/sqlite/store_directory.h"

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
    return Error{Errc::Unsupported, "this disk cannot hold the store's log: use a local disk"}.at(
        database.where());
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

Result<void> open_to_write(Database& database, StoreKeys& keys, WallTime at,
                           const SqliteStoreOptions& options) {
  RELIEVO_TRY(make_private_file(database.file()));
  RELIEVO_TRY(database.open(true));
  RELIEVO_TRY(set_up(database, options));
  RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(database));
  RELIEVO_TRY(set_up_writing(database, options));
  RELIEVO_TRY(database.tidy_up_on_close(true));
  RELIEVO_TRY(make_current(database, version, keys, at));
  // Power may have gone in the middle of an erasure, or of the migration that sealed an older store.
  RELIEVO_TRY(remove_erased_rows(database));
  RELIEVO_TRY(remove_plain_copies(database.file()));
  RELIEVO_TRY(remove_plain_traces(database));
  return database.run("PRAGMA wal_checkpoint(TRUNCATE)");
}

Result<void> open_to_read(Database& database, StoreKeys& keys, const SqliteStoreOptions& options) {
  std::error_code ignored;
  if (!fs::exists(database.file(), ignored)) {
    return Error{Errc::NotFound, "there is no store: check the path"}.at(database.where());
  }
  RELIEVO_TRY(database.open(false));
  RELIEVO_TRY(set_up(database, options));
  RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(database));
  if (version < store_version()) {
    return Error{Errc::InvalidState, "the store is of an older version: open it to write once"}.at(
        database.where());
  }
  return keys.load(database);
}

WallTime time_of(const hal::Clock& clock) {
  return std::chrono::time_point_cast<std::chrono::milliseconds>(clock.wall_now());
}

}  // namespace

WallTime SqliteStore::now() const { return time_of(clock_); }

Error SqliteStore::not_found(Literal what, std::int64_t number) const {
  return Error{Errc::NotFound, what}.at(std::to_string(number));
}

Result<std::unique_ptr<Store>> open_sqlite_store(const fs::path& dir, const hal::Clock& clock,
                                                 const SqliteStoreOptions& options) {
  return without_exceptions(dir.native(), [&]() -> Result<std::unique_ptr<Store>> {
    const bool writable = options.mode == OpenMode::ReadWrite;
    std::error_code failed;
    if (writable) RELIEVO_TRY(make_store_directory(fs::absolute(dir, failed)));
    // No link may stand in for the file; links on the way to it are the caller's business.
    const fs::path home = fs::weakly_canonical(dir, failed);
    auto lock = std::make_unique<StoreLock>();
    if (writable) RELIEVO_TRY(lock->take(home / "relievo.lock", options.wait_for_lock));
    auto database = std::make_unique<Database>(home / "relievo.db");
    RELIEVO_TRY_ASSIGN(auto keys,
                       StoreKeys::make(options.keys ? options.keys : key_file(home / "relievo.key")));
    const WallTime at = time_of(clock);
    auto ready =
        writable ? open_to_write(*database, *keys, at, options) : open_to_read(*database, *keys, options);
    if (!ready && ready.error().code == Errc::MediaFull && give_up_reserve(home)) {
      database = std::make_unique<Database>(home / "relievo.db");
      ready = open_to_write(*database, *keys, at, options);
    }
    if (!ready) return ready.error();
    if (writable) set_aside_reserve(home, options.reserve_bytes);
    auto store =
        std::make_unique<SqliteStore>(std::move(lock), std::move(database), std::move(keys), clock, options);
    return std::unique_ptr<Store>(std::move(store));
  });
}

}  // namespace relievo::storage
