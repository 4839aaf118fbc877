// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_migration.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "storage/export/atomic_file.h"
#include "storage/schema/embedded_sql.h"

namespace relievo::storage {
namespace {

std::filesystem::path copy_before(const std::filesystem::path& file, std::int64_t version) {
  return file.string() + ".before-" + std::to_string(version);
}

// The old file beside the new one, complete or not there at all.
Result<void> copy_aside(Database& database, std::int64_t next_version) {
  const auto target = copy_before(database.file(), next_version);
  const auto unfinished = std::filesystem::path(target.string() + ".tmp");
  const auto failed = [&] {
    return Error{Errc::IoFailed, "the store could not be copied before its migration", errno}.at(
        target.string());
  };
  ::unlink(unfinished.c_str());
  // Made here so that nobody else may read it, not even while it grows.
  const int made = ::open(unfinished.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (made < 0) return failed();
  ::close(made);
  if (auto copied = database.copy_to(unfinished); !copied) {
    ::unlink(unfinished.c_str());
    return copied;
  }
  if (::rename(unfinished.c_str(), target.c_str()) != 0) {
    const Error error = failed();
    ::unlink(unfinished.c_str());
    return error;
  }
  return sync_directory(target.parent_path());
}

Result<void> apply(Database& database, std::int64_t version) {
  if (version == 0) return database.run(std::string(schema_sql()).c_str());
  for (auto n = static_cast<std::size_t>(version); n < migrations().size(); ++n) {
    RELIEVO_TRY(database.run(std::string(migrations()[n]).c_str()));
  }
  return {};
}

}  // namespace

std::int64_t store_version() { return static_cast<std::int64_t>(migrations().size()); }

Result<std::int64_t> version_of(Database& database) {
  RELIEVO_TRY_ASSIGN(const std::int64_t application, database.integer("PRAGMA application_id"));
  RELIEVO_TRY_ASSIGN(const std::int64_t version, database.integer("PRAGMA user_version"));
  RELIEVO_TRY_ASSIGN(const std::int64_t tables, database.integer("SELECT count(*) FROM sqlite_schema"));
  if (application == 0 && version == 0 && tables == 0) return 0;
  if (application != kApplicationId || version < 1) {
    return Error{Errc::InvalidInput, "this file is another program's database: give another directory"}.at(
        database.where());
  }
  if (version > store_version()) {
    RELIEVO_TRY_ASSIGN(const std::int64_t compatible,
                       database.integer("SELECT compatible_version FROM store_info"));
    if (compatible > store_version() || compatible < 1) {
      return Error{Errc::StoreNewer,
                   "the store was made by a newer version, and was left as it is: update Relievo"}
          .at(database.where());
    }
  }
  return version;
}

Result<void> make_current(Database& database, std::int64_t version) {
  if (version >= store_version()) return {};
  if (version > 0) RELIEVO_TRY(copy_aside(database, version + 1));
  Transaction transaction(database);
  RELIEVO_TRY(transaction.begin());
  RELIEVO_TRY(apply(database, version));
  const std::string stamp = "PRAGMA application_id = " + std::to_string(kApplicationId) +
                            "; PRAGMA user_version = " + std::to_string(store_version());
  RELIEVO_TRY(database.run(stamp.c_str()));
  RELIEVO_TRY_ASSIGN(auto broken, database.prepare("PRAGMA foreign_key_check"));
  RELIEVO_TRY_ASSIGN(const bool found, broken.step());
  if (found)
    return Error{Errc::StoreCorrupt, "the store could not be migrated: a record in it has lost its owner"}.at(
        database.where());
  return transaction.commit();
}

Result<void> remove_old_copies(const std::filesystem::path& database_file) {
  for (std::int64_t version = 2; version <= store_version(); ++version) {
    const auto copy = copy_before(database_file, version);
    if (::unlink(copy.c_str()) != 0 && errno != ENOENT) {
      return Error{Errc::IoFailed,
                   "an old copy of the store, with people in it, could not be removed: remove it by hand",
                   errno}
          .at(copy.string());
    }
  }
  return {};
}

}  // namespace relievo::storage
