// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/sqlite_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <thread>

#include "storage/sqlite/sqlite_change.h"
#include "storage/sqlite/sqlite_migration.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;

class Lock {
 public:
  ~Lock() {
    if (fd_ >= 0) ::close(fd_);
  }
  Lock() = default;
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  int release() { return std::exchange(fd_, -1); }

  // A file of its own: any close() of relievo.db in this process would drop SQLite's locks on it.
  Result<void> take(const fs::path& file, std::chrono::milliseconds wait) {
    fd_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (fd_ < 0) return sqlite_error(14 /* cannot open */, errno, file.string());
    constexpr std::chrono::milliseconds kPause{20};
    for (auto waited = kPause * 0; ::flock(fd_, LOCK_EX | LOCK_NB) != 0; waited += kPause) {
      if (errno != EWOULDBLOCK && errno != EINTR) {
        return Error{Errc::IoFailed, "the store could not be locked", errno}.at(file.string());
      }
      if (waited >= wait) {
        return Error{Errc::Timeout, "another program is using the store: close it, then try again"}.at(file.parent_path().string());
      }
      std::this_thread::sleep_for(kPause);
    }
    return {};
  }

 private:
  int fd_ = -1;
};

// A directory that is there already keeps its mode: it may hold other things than ours.
Result<void> make_directory(const fs::path& dir) {
  std::error_code ignored;
  if (fs::is_directory(dir, ignored)) return {};
  std::error_code failed;
  fs::create_directories(dir.parent_path(), failed);
  if (::mkdir(dir.c_str(), 0700) != 0 && errno != EEXIST) {
    if (errno == ENOSPC) return sqlite_error(13 /* full */, errno, dir.string());
    return Error{Errc::IoFailed, "the directory of the store cannot be made: check the path and its owner", errno}.at(dir.string());
  }
  if (!fs::is_directory(dir, ignored)) return Error{Errc::InvalidInput, "the store needs a directory, this is none"}.at(dir.string());
  return {};
}

// SQLite would make the file by the umask; its log and index take over the file's mode.
Result<void> make_private(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd >= 0) ::close(fd);
  if ((fd < 0 && errno != EEXIST) || ::chmod(file.c_str(), 0600) != 0) {
    return sqlite_error(14 /* cannot open */, errno, file.string());
  }
  return {};
}

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
    return Error{Errc::Unsupported, "this disk cannot hold the store's log: use a local disk"}.at(database.where());
  }
  RELIEVO_TRY(mode.run());
  RELIEVO_TRY(database.run("PRAGMA synchronous = FULL; PRAGMA journal_size_limit = 4194304"));
  if (options.max_bytes > 0) {
    RELIEVO_TRY_ASSIGN(const std::int64_t page, database.integer("PRAGMA page_size"));
    const std::string limit = "PRAGMA max_page_count = " + std::to_string(options.max_bytes / page);
    RELIEVO_TRY(database.run(limit.c_str()));
  }
  return {};
}

Result<void> open_to_write(Database& database, const SqliteStoreOptions& options) {
  RELIEVO_TRY(make_private(database.file()));
  RELIEVO_TRY(database.open(true));
  RELIEVO_TRY(set_up(database, options));
  RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(database));
  RELIEVO_TRY(set_up_writing(database, options));
  RELIEVO_TRY(database.tidy_up_on_close(true));
  RELIEVO_TRY(make_current(database, version));
  // Power may have gone between an erasure and the emptying of the log.
  return database.run("PRAGMA wal_checkpoint(TRUNCATE)");
}

Result<void> open_to_read(Database& database, const SqliteStoreOptions& options) {
  std::error_code ignored;
  if (!fs::exists(database.file(), ignored)) {
    return Error{Errc::NotFound, "there is no store: check the path"}.at(database.where());
  }
  RELIEVO_TRY(database.open(false));
  RELIEVO_TRY(set_up(database, options));
  RELIEVO_TRY_ASSIGN(const std::int64_t version, version_of(database));
  if (version < store_version()) {
    return Error{Errc::InvalidState, "the store is of an older version: open it to write once"}.at(database.where());
  }
  return {};
}

}  // namespace

SqliteStore::~SqliteStore() {
  database_.reset();
  if (lock_fd_ >= 0) ::close(lock_fd_);
}

WallTime SqliteStore::now() const {
  return std::chrono::time_point_cast<std::chrono::milliseconds>(clock_.wall_now());
}

Error SqliteStore::not_found(Literal what, std::int64_t number) const {
  return Error{Errc::NotFound, what}.at(std::to_string(number));
}

Result<std::unique_ptr<Store>> open_sqlite_store(const fs::path& dir, const hal::Clock& clock,
                                                 const SqliteStoreOptions& options) {
  return without_exceptions(dir.native(), [&]() -> Result<std::unique_ptr<Store>> {
    const bool writable = options.mode == OpenMode::ReadWrite;
    std::error_code failed;
    if (writable) RELIEVO_TRY(make_directory(fs::absolute(dir, failed)));
    // No link may stand in for the file; links on the way to it are the caller's business.
    const fs::path home = fs::weakly_canonical(dir, failed);
    Lock lock;
    if (writable) RELIEVO_TRY(lock.take(home / "relievo.lock", options.wait_for_lock));
    auto database = std::make_unique<Database>(home / "relievo.db");
    RELIEVO_TRY(writable ? open_to_write(*database, options) : open_to_read(*database, options));
    auto store = std::make_unique<SqliteStore>(std::move(database), clock, options.mode, lock.release());
    return std::unique_ptr<Store>(std::move(store));
  });
}

}  // namespace relievo::storage
