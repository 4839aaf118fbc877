// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <new>
#include <string>

namespace relievo::hal {
namespace {

// Close-once for the few lines below; hal/linux has the one for devices.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

Error write_error(int number, const std::filesystem::path& file) {
  if (number == ENOSPC || number == EDQUOT || number == EFBIG)
    return Error{Errc::MediaFull, "no room left to write this file; free some space", number}.at(
        file.native());
  return Error{Errc::IoFailed, "cannot write this file; check that the folder exists and may be written",
               number}
      .at(file.native());
}

// 0 or the errno of what failed.
int write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return 0;
}

bool is_device(const std::filesystem::path& file) {
  struct stat info {};
  return ::stat(file.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
}

Result<void> write_device(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const Descriptor out{::open(file.c_str(), O_WRONLY | O_CLOEXEC)};
  if (out.fd < 0) return write_error(errno, file);
  if (const int failed = write_all(out.fd, bytes); failed != 0) return write_error(failed, file);
  return {};
}

std::filesystem::path temporary_beside(const std::filesystem::path& file) {
  static std::atomic<unsigned> counter{0};
  // Piece by piece: g++ 12 warns wrongly about a literal + string.
  std::string name(1, '.');
  name.append(file.filename().native()).append(1, '.').append(std::to_string(::getpid()));
  name.append(1, '-').append(std::to_string(counter.fetch_add(1))).append(".part");
  return file.parent_path() / name;
}

int write_and_sync(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const Descriptor out{::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
  if (out.fd < 0) return errno;
  if (const int failed = write_all(out.fd, bytes); failed != 0) return failed;
  return ::fsync(out.fd) == 0 ? 0 : errno;
}

// The new name itself must survive a power cut. Best effort: FAT, for one, cannot sync a folder.
void sync_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const Descriptor dir{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (dir.fd >= 0) ::fsync(dir.fd);
}

Result<std::size_t> regular_size(int fd, const std::filesystem::path& file, std::size_t limit_bytes) {
  struct stat info {};
  if (::fstat(fd, &info) != 0) return Error{Errc::IoFailed, "cannot read this file", errno}.at(file.native());
  if (!S_ISREG(info.st_mode)) return Error{Errc::InvalidInput, "this is not a file"}.at(file.native());
  if (info.st_size == 0) return Error{Errc::InvalidInput, "this file is empty"}.at(file.native());
  const auto size = static_cast<std::size_t>(info.st_size);
  if (size > limit_bytes)
    return Error{Errc::InvalidInput, "this file is larger than its limit"}.at(file.native());
  return size;
}

}  // namespace

Result<std::vector<std::byte>> read_whole_file(const std::filesystem::path& file,
                                               std::size_t limit_bytes) try {
  // O_NONBLOCK: a FIFO under this name must not hold us up; regular files do not care.
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (in.fd < 0) {
    const int number = errno;
    if (number == ENOENT || number == ENOTDIR)
      return Error{Errc::NotFound, "there is no such file; check its name", number}.at(file.native());
    return Error{Errc::IoFailed, "cannot open this file", number}.at(file.native());
  }
  RELIEVO_TRY_ASSIGN(const std::size_t size, regular_size(in.fd, file, limit_bytes));
  std::vector<std::byte> bytes(size);
  std::size_t got = 0;
  while (got < size) {
    const ssize_t n = ::read(in.fd, bytes.data() + got, size - got);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return Error{Errc::IoFailed, "cannot read this file", errno}.at(file.native());
    if (n == 0) return Error{Errc::IoFailed, "this file shrank while it was read"}.at(file.native());
    got += static_cast<std::size_t>(n);
  }
  return bytes;
} catch (const std::bad_alloc&) {
  return Error{Errc::OutOfMemory, "no memory to read this file"}.at(file.native());
}

Result<void> write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  if (file.filename().empty())
    return Error{Errc::InvalidInput, "this is not the name of a file"}.at(file.native());
  if (is_device(file)) return write_device(file, bytes);
  const std::filesystem::path part = temporary_beside(file);
  int failed = write_and_sync(part, bytes);
  if (failed == 0 && ::rename(part.c_str(), file.c_str()) != 0) failed = errno;
  if (failed != 0) {
    ::unlink(part.c_str());
    return write_error(failed, file);
  }
  sync_folder_of(file);
  return {};
}

}  // namespace relievo::hal
