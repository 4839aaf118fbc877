// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "storage/export/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>

namespace relievo::storage {
namespace {

namespace fs = std::filesystem;

Error failed(const fs::path& file, int cause) {
  const auto made = [&](Errc code, Literal what) { return Error{code, what, cause}.at(file.string()); };
  switch (cause) {
    case ENOSPC:
    case EDQUOT:
      return made(Errc::MediaFull, "not written, the disk is full: make room there and try again");
    case EFBIG:
      return made(Errc::MediaFull, "not written, the file is larger than this disk takes: use another disk");
    case EACCES:
    case EPERM:
    case EROFS:
      return made(Errc::IoFailed,
                  "not written, this place may not be written to: choose another, or change its permissions");
    case ENOENT:
    case ENOTDIR:
      return made(Errc::IoFailed, "not written, there is no such directory: check the path");
    case EISDIR:
      return made(Errc::IoFailed,
                  "not written, a directory has this name: remove it or choose another place");
    default:
      return made(Errc::IoFailed,
                  "not written, the disk failed: check it, and write to another if this happens again");
  }
}

Result<void> sync_one(const fs::path& named, int flags) {
  const int fd = ::open(named.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (fd < 0) return failed(named, errno);
  const int code = ::fsync(fd);
  const int cause = errno;
  ::close(fd);
  // Not every file system can sync a directory (EINVAL): then there is nothing more to be had.
  if (code != 0 && cause != EINVAL && cause != ENOTSUP) return failed(named, cause);
  return {};
}

}  // namespace

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
  while (!bytes.empty()) {
    const ssize_t done = ::write(fd_, bytes.data(), std::min<std::size_t>(bytes.size(), 1u << 20));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return failed(target_, done < 0 ? errno : EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
  return {};
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

Result<void> write_file(const fs::path& target, std::span<const std::byte> bytes) {
  RELIEVO_TRY_ASSIGN(auto file, PendingFile::create(target));
  RELIEVO_TRY(file.write(bytes));
  RELIEVO_TRY(file.finish());
  RELIEVO_TRY(file.publish());
  return sync_renamed(target);
}

}  // namespace relievo::storage
