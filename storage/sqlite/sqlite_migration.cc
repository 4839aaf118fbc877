// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_parts.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <string>

#include "hal/base/whole_file.h"
#include "storage/schema/embedded_sql.h"

namespace relievo::storage {
namespace {

constexpr std::int64_t kRoomToSeal = 7;  // the migration before the sealing

std::filesystem::path with_end(const std::filesystem::path& file, const char* end) {
  return file.string() + end;
}

std::filesystem::path copy_before(const std::filesystem::path& file, std::int64_t version) {
  return file.string() + ".before-" + std::to_string(version);
}

// One transaction: `before`, the migrations to version `to`, `after`.
template <typename Before, typename After>
Result<void> step(Database& database, std::int64_t from, std::int64_t to, const Before& before,
                  const After& after) {
  Transaction transaction(database);
  RELIEVO_TRY(transaction.begin());
  RELIEVO_TRY(before());
  if (from == 0) RELIEVO_TRY(database.run(std::string(schema_sql()).c_str()));
  for (std::int64_t n = from; from > 0 && n < to; ++n)
    RELIEVO_TRY(database.run(std::string(migrations()[std::size_t(n)]).c_str()));
  RELIEVO_TRY(after());
  const std::string stamp = "PRAGMA application_id = " + std::to_string(kApplicationId) +
                            "; PRAGMA user_version = " + std::to_string(to);
  RELIEVO_TRY(database.run(stamp.c_str()));
  RELIEVO_TRY_ASSIGN(const auto broken, database.row("PRAGMA foreign_key_check"));
  if (broken)
    return database.error(Errc::StoreCorrupt,
                          "the store could not be migrated: a record in it has lost its owner");
  return transaction.commit();
}

}  // namespace

Result<void> remove_copies(const std::filesystem::path& database_file, std::int64_t last) {
  bool removed = false;
  for (std::int64_t version = 2; version <= last; ++version) {
    const auto copy = copy_before(database_file, version);
    // The others: of a copy that a power cut stopped.
    for (const char* end : {"", ".tmp", ".tmp-journal", ".tmp-wal", ".tmp-shm"}) {
      const auto file = with_end(copy, end);
      if (::unlink(file.c_str()) == 0) {
        removed = true;
      } else if (errno != ENOENT) {
        return Error{Errc::IoFailed,
                     "an old copy of the store, with people in it, could not be removed: remove it by hand",
                     errno}
            .at(file.string());
      }
    }
  }
  // A power cut may not bring them back.
  return removed ? sync_directory(database_file.parent_path()) : Result<void>();
}

Result<void> copy_whole(Database& database, const std::filesystem::path& target,
                        const std::filesystem::path& unfinished) {
  const auto failed = [&] {
    return Error{Errc::IoFailed, "the store could not be copied here: check the place", errno}.at(
        target.string());
  };
  const auto remove_unfinished = [&] {
    for (const char* beside : {"", "-journal", "-wal", "-shm"})
      ::unlink(with_end(unfinished, beside).c_str());
  };
  remove_unfinished();
  // Made here so that nobody else may read it, not even while it grows.
  const int made = ::open(unfinished.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (made < 0) return failed();
  ::close(made);
  Result<void> done = database.copy_to(unfinished);
  if (done && ::rename(unfinished.c_str(), target.c_str()) != 0) done = failed();
  if (done) return sync_directory(target.parent_path());
  remove_unfinished();
  return done;
}

Result<void> check_schema(Database& database) {
  RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(database));
  if (version != store_version()) return {};         // a newer one may have more
  using Parts = std::map<std::string, std::string>;  // the name: all of it
  const auto parts_of = [](Database& one, Parts& parts) {
    return one.each("SELECT type || ' ' || name, tbl_name || coalesce(sql, '') FROM sqlite_schema",
                    [&](const Statement& row) {
                      parts.insert_or_assign(std::string(row.text(0)), std::string(row.text(1)));
                    });
  };
  Database made(":memory:");
  RELIEVO_TRY(made.open(true));
  RELIEVO_TRY(made.run(std::string(schema_sql()).c_str()));
  Parts ours, theirs;
  RELIEVO_TRY(parts_of(made, ours));
  RELIEVO_TRY(parts_of(database, theirs));
  for (const auto& [name, whole] : theirs) {
    const auto found = ours.find(name);
    if (found == ours.end() || found->second != whole)
      return Error{Errc::StoreCorrupt, "is in the store, and Relievo did not make it: restore a copy"}.at(
          name);
  }
  for (const auto& [name, whole] : ours)
    if (!theirs.contains(name))
      return Error{Errc::StoreCorrupt, "is missing in the store: restore a copy"}.at(name);
  return {};
}

std::int64_t store_version() { return std::int64_t(migrations().size()); }

Result<std::int64_t> version_of(Database& database) {
  RELIEVO_TRY_ASSIGN(const std::int64_t application, database.integer("PRAGMA application_id"));
  RELIEVO_TRY_ASSIGN(const std::int64_t version, database.integer("PRAGMA user_version"));
  RELIEVO_TRY_ASSIGN(const std::int64_t tables, database.integer("SELECT count(*) FROM sqlite_schema"));
  if (application == 0 && version == 0 && tables == 0) return 0;
  if (application != kApplicationId || version < 1) {
    return database.error(Errc::InvalidInput,
                          "this file is another program's database: give another directory");
  }
  if (version > store_version()) {
    RELIEVO_TRY_ASSIGN(const std::int64_t compatible,
                       database.integer("SELECT compatible_version FROM store_info"));
    if (compatible > store_version() || compatible < 1) {
      return database.error(Errc::StoreNewer,
                            "the store was made by a newer version, and was left as it is: update Relievo");
    }
  }
  return version;
}

Result<void> make_current(Database& database, std::int64_t version, StoreKeys& keys, WallTime at) {
  const auto nothing = [] { return Result<void>(); };
  const auto make_keys = [&] { return keys.create(database, at); };
  const auto make_all = [&]() -> Result<void> {
    RELIEVO_TRY(make_keys());
    return begin_audit(database, keys);
  };
  if (version == 0) return step(database, 0, store_version(), nothing, make_all);
  if (version >= store_version()) return keys.load(database, false);
  // Half way through the sealing the copy is there already.
  const auto copy = copy_before(database.file(), version + 1);
  if (version != kRoomToSeal) RELIEVO_TRY(copy_whole(database, copy, with_end(copy, ".tmp")));
  if (version < kRoomToSeal) RELIEVO_TRY(step(database, version, kRoomToSeal, nothing, make_keys));
  else RELIEVO_TRY(keys.load(database, false));
  const auto key_end = [&] { return key_audit_end(database, keys); };
  if (version == kAllSealed) return step(database, version, store_version(), nothing, key_end);
  if (version > kAllSealed) return step(database, version, store_version(), nothing, nothing);
  RELIEVO_TRY(seal_people(database, keys));
  return step(
      database, kRoomToSeal, store_version(), [&] { return seal_the_rest(database, keys); }, nothing);
}
}  // namespace relievo::storage
