// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/sqlite/store_directory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <thread>

#include "hal/base/whole_file.h"

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;

Error failed(const fs::path& place, int cause) {
  if (cause == ENOSPC || cause == EDQUOT) {
    return Error{Errc::MediaFull, "the disk is full: make room, then try again", cause}.at(place.native());
  }
  return Error{Errc::IoFailed, "the store cannot be made or opened here: check the path and its owner", cause}
      .at(place.native());
}

Error unseen(const fs::path& place, int cause) {
  return Error{Errc::IoFailed,
               "the store cannot be looked for here: check the path, its owner and permissions", cause}
      .at(place.native());
}

}  // namespace

StoreLock::~StoreLock() {
  if (fd_ >= 0) ::close(fd_);
}

// A file of its own: any close() of relievo.db in this process would drop SQLite's locks on it.
Result<void> StoreLock::take(const fs::path& file, std::chrono::milliseconds wait) {
  fd_ = ::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd_ < 0) return failed(file, errno);
  give_to_owner_of(file.parent_path(), fd_);
  constexpr std::chrono::milliseconds kPause{20};
  for (auto waited = kPause * 0; ::flock(fd_, LOCK_EX | LOCK_NB) != 0; waited += kPause) {
    if (errno != EWOULDBLOCK && errno != EINTR) {
      return Error{Errc::IoFailed, "the store could not be locked", errno}.at(file.string());
    }
    if (waited >= wait) {
      return Error{Errc::Timeout, "another program is using the store: close it, then try again"}.at(
          file.parent_path().string());
    }
    std::this_thread::sleep_for(kPause);
  }
  return {};
}

Result<void> make_store_directory(const fs::path& named) {
  const fs::path dir = named.has_filename() ? named : named.parent_path();  // "store/"
  std::error_code ignored;
  if (fs::is_directory(dir, ignored)) return {};
  fs::path there = dir.parent_path();
  while (there != there.parent_path() && !fs::exists(there, ignored)) there = there.parent_path();
  fs::create_directories(dir.parent_path(), ignored);
  if (::mkdir(dir.c_str(), 0700) != 0 && errno != EEXIST) {
    return failed(dir, errno);
  }
  if (!fs::is_directory(dir, ignored))
    return invalid("the store needs a directory, this is none").at(dir.string());
  // What is synced in it later is lost with its name.
  for (fs::path made = dir; made != there; made = made.parent_path())
    RELIEVO_TRY(sync_directory(made.parent_path()));
  return {};
}

Result<fs::path> home_of(const fs::path& dir) {
  std::error_code failed;
  fs::path home = fs::weakly_canonical(dir, failed);
  if (failed) return unseen(dir, failed.value());
  return home;
}

Result<void> must_be_there(const fs::path& file) {
  std::error_code failed;
  if (fs::exists(file, failed)) return {};
  if (failed) return unseen(file, failed.value());
  return Error{Errc::NotFound, "there is no store: check the path"}.at(file.native());
}

Result<void> must_take_files(const fs::path& dir) {
  if (::access(dir.c_str(), W_OK) == 0) return {};
  return Error{
      Errc::IoFailed,
      "this store can be read only where this user may also write: make a copy of it, and look at that",
      errno}
      .at(dir.native());
}

Result<void> make_private_file(const fs::path& file) {
  const fs::path folder = file.parent_path();
  const int fd = ::open(file.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd >= 0) {
    give_to_owner_of(folder, fd);
    ::close(fd);
  }
  if ((fd < 0 && errno != EEXIST) || ::chmod(file.c_str(), 0600) != 0) {
    return failed(file, errno);
  }
  return {};
}

void set_aside_reserve(const fs::path& dir, std::int64_t bytes) noexcept try {
  constexpr std::int64_t kTooSmall = 65'536;
  const fs::path file = dir / "relievo.reserve";
  // O_NONBLOCK: what is no file under this name must not hold us up.
  const int fd = ::open(file.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
  if (fd < 0) return;
  give_to_owner_of(dir, fd);
  // A power cut may have left it empty.
  struct stat kept {};
  if (::fstat(fd, &kept) != 0 || !S_ISREG(kept.st_mode) || kept.st_size >= kTooSmall) {
    ::close(fd);
    return;
  }
  // ext4 keeps what it got before there was no more room.
  while (bytes >= kTooSmall && ::posix_fallocate(fd, 0, bytes) != 0 && ::ftruncate(fd, 0) == 0)
    bytes -= bytes / 32;
  ::close(fd);
  if (bytes < kTooSmall) ::unlink(file.c_str());
} catch (const std::bad_alloc&) {  // the next time
}

bool give_up_reserve(const fs::path& dir) { return ::unlink((dir / "relievo.reserve").c_str()) == 0; }

}  // namespace relievo::storage
