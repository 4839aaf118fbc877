// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/base/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>

#include "hal/base/words.h"

namespace relievo {
namespace {

namespace fs = std::filesystem;

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

Error failed(const fs::path& file, int cause) {
  constexpr Meaning kRows[] = {
      {{ENOSPC, EDQUOT}, Errc::MediaFull, "not written, the disk is full: make room there and try again"},
      {{EFBIG}, Errc::MediaFull, "not written, the file is larger than this disk takes: use another disk"},
      {{EACCES, EPERM, EROFS},
       Errc::IoFailed,
       "not written, this place may not be written to: choose another, or change its permissions"},
      {{ENOENT, ENOTDIR}, Errc::IoFailed, "not written, there is no such directory: check the path"},
      {{EISDIR}, Errc::IoFailed, "not written, a directory has this name: remove it or choose another place"},
      {{},
       Errc::IoFailed,
       "not written, the disk failed: check it, and write to another if this happens again"}};
  return meaning_of(cause, kRows).at(file.string());
}

// 0 or the errno of what failed.
int write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(fd, bytes.data(), std::min<std::size_t>(bytes.size(), 1u << 20));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done < 0 ? errno : EIO;
    bytes = bytes.subspan(std::size_t(done));
  }
  return 0;
}

Result<void> sync_one(const fs::path& named, int flags) {
  const Descriptor file{::open(named.c_str(), O_RDONLY | O_CLOEXEC | flags)};
  if (file.fd < 0) return failed(named, errno);
  // Not every file system can sync a directory (EINVAL): then there is nothing more to be had.
  if (::fsync(file.fd) != 0 && errno != EINVAL && errno != ENOTSUP) return failed(named, errno);
  return {};
}

Result<std::vector<std::byte>> read_file(const fs::path& file, std::size_t limit_bytes, int flags) try {
  // O_NONBLOCK: a FIFO under this name must not hold us up; regular files do not care.
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | flags)};
  if (in.fd < 0) {
    const int number = errno;
    if (number == ENOENT || number == ENOTDIR)
      return Error{Errc::NotFound, "there is no such file; check its name", number}.at(file.native());
    return Error{Errc::IoFailed, "cannot open this file", number}.at(file.native());
  }
  struct stat info {};
  if (::fstat(in.fd, &info) != 0)
    return Error{Errc::IoFailed, "cannot read this file", errno}.at(file.native());
  if (!S_ISREG(info.st_mode)) return invalid("this is not a file").at(file.native());
  const auto size = std::size_t(info.st_size);
  if (size > limit_bytes) return invalid("this file is larger than its limit").at(file.native());
  std::vector<std::byte> bytes(size);
  std::size_t got = 0;
  while (got < size) {
    const ssize_t n = ::read(in.fd, bytes.data() + got, size - got);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return Error{Errc::IoFailed, "cannot read this file", errno}.at(file.native());
    if (n == 0) return Error{Errc::IoFailed, "this file shrank while it was read"}.at(file.native());
    got += std::size_t(n);
  }
  return bytes;
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to read this file"}.at(file.native());
}

}  // namespace

Result<std::vector<std::byte>> read_whole_file(const fs::path& file, std::size_t limit_bytes) {
  auto bytes = read_file(file, limit_bytes, 0);
  if (bytes && bytes->empty()) return invalid("this file is empty").at(file.native());
  return bytes;
}

Result<std::vector<std::byte>> read_own_file(const fs::path& file, std::size_t limit_bytes) {
  return read_file(file, limit_bytes, O_NOFOLLOW);
}

void give_to_owner_of(const fs::path& place, int fd) {
  struct stat owner {
  }, file{};
  if (::geteuid() != 0 || ::stat(place.c_str(), &owner) != 0 || ::fstat(fd, &file) != 0) return;
  if (!S_ISREG(file.st_mode) || file.st_nlink != 1) return;
  // Not every file system has owners.
  if (::fchown(fd, owner.st_uid, owner.st_gid) != 0) return;
}

Result<PendingFile> PendingFile::create(const fs::path& target, unsigned mode) {
  // Short and plain, for the sake of FAT; hidden, in case it is ever left behind by a power cut.
  // The object first: once the file is there, nothing may throw before somebody removes it.
  PendingFile file(target, target.parent_path() / ("." + target.filename().string() + ".part"), -1);
  ::unlink(file.temporary_.c_str());
  file.fd_ = ::open(file.temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode);
  if (file.fd_ < 0) return failed(target, errno);
  return file;
}

PendingFile::~PendingFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<void> PendingFile::write(std::span<const std::byte> bytes) {
  const int cause = write_all(fd_, bytes);
  return cause == 0 ? Result<void>() : failed(target_, cause);
}

Result<void> PendingFile::finish() {
  if (::fsync(fd_) != 0) return failed(target_, errno);
  // Some file systems tell of a full disk only here.
  if (::close(std::exchange(fd_, -1)) != 0) return failed(target_, errno);
  return {};
}

Result<void> PendingFile::publish() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return failed(target_, errno);
  temporary_.clear();
  return {};
}

Result<void> sync_directory(const fs::path& dir) {
  return sync_one(dir.empty() ? fs::path(".") : dir, O_DIRECTORY);
}

Result<void> sync_renamed(const fs::path& target) {
  RELIEVO_TRY(sync_one(target, 0));
  return sync_directory(target.parent_path());
}

Result<void> write_whole_file(const fs::path& file, std::span<const std::byte> bytes,
                              const std::function<Result<void>()>& before, unsigned mode) {
  if (file.filename().empty()) return invalid("this is not the name of a file").at(file.native());
  struct stat info {};
  if (::stat(file.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode)) {  // a device
    const Descriptor out{::open(file.c_str(), O_WRONLY | O_CLOEXEC)};
    const int cause = out.fd < 0 ? errno : write_all(out.fd, bytes);
    if (cause != 0) return failed(file, cause);
    return before ? before() : Result<void>();
  }
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) return failed(file, EISDIR);
  RELIEVO_TRY_ASSIGN(auto pending, PendingFile::create(file, mode));
  RELIEVO_TRY(pending.write(bytes));
  RELIEVO_TRY(pending.finish());
  if (before) RELIEVO_TRY(before());
  RELIEVO_TRY(pending.publish());
  return sync_renamed(file);
}

}  // namespace relievo
