// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The C library's calls that change a disk, as this program has them: each does its work and tells the log.
// What a library calls (SQLite, libstdc++'s filesystem) comes here too, because a program's own names go
// before a library's. A sync tells the log only: there is no power to be cut here (on a
// logged device, where there is, it does its work).
#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <memory>
#include <mutex>
#include <optional>

#include "tests/power/disk_log.h"
#include "tests/power/logged_device.h"
#include "tests/support/temporary_folder.h"

namespace relievo::test {
namespace {

namespace fs = std::filesystem;
using Kind = DiskChange::Kind;

struct Place {
  int folder;
  std::string name;
  int node;  // -1: there is none of this name
};

struct Watch {
  explicit Watch(const fs::path& at) : root(at), log{DiskTree::of(at), {}}, now(log.before) {}

  DiskTree::Node& node(int number) { return now.nodes[static_cast<std::size_t>(number)]; }

  // Nothing: it is not below the root.
  std::optional<Place> find(int dirfd, const char* path) {
    fs::path whole = path;
    if (whole.is_relative())
      whole = (dirfd == AT_FDCWD ? fs::current_path()
                                 : fs::read_symlink("/proc/self/fd/" + std::to_string(dirfd))) /
              whole;
    const fs::path inside = whole.lexically_normal().lexically_relative(root);
    if (inside.empty() || *inside.begin() == "..") return std::nullopt;
    Place place{0, "", 0};
    for (const fs::path& part : inside) {
      if (part == "." || part.empty()) continue;
      if (place.node < 0) return std::nullopt;
      place = {place.node, part.string(), -1};
      const auto& names = node(place.folder).names;
      if (const auto found = names.find(place.name); found != names.end()) place.node = found->second;
    }
    return place;
  }

  void names(std::vector<DiskChange::Name> changed, bool folder = false) {
    for (const auto& [where, name, to] : changed) {
      if (to < 0) node(where).names.erase(name);
      else node(where).names[name] = to;
    }
    log.changes.push_back({Kind::Names, -1, folder ? 1U : 0U, {}, std::move(changed)});
  }
  int make(const Place& place, bool folder) {
    now.nodes.push_back({folder});
    const int made = static_cast<int>(now.nodes.size()) - 1;
    names({{place.folder, place.name, made}}, folder);
    return made;
  }
  void size(int number, std::size_t bytes) {
    if (node(number).bytes.size() == bytes) return;
    node(number).bytes.resize(bytes);
    log.changes.push_back({Kind::Size, number, bytes});
  }
  void write(int number, std::size_t at, const void* bytes, std::size_t count) {
    std::string text(static_cast<const char*>(bytes), count);
    auto& file = node(number).bytes;
    if (file.size() < at + count) file.resize(at + count);
    file.replace(at, count, text);
    log.changes.push_back({Kind::Write, number, at, std::move(text)});
  }

  fs::path root;
  DiskLog log;
  DiskTree now;
  std::map<int, int> open;  // the file of a descriptor
};

std::mutex g_mutex;
std::unique_ptr<Watch> g_watch;

// Of what went well only.
template <typename Tell>
long told(long result, const Tell& tell) {
  const int cause = errno;
  if (result >= 0) {
    const std::lock_guard lock(g_mutex);
    if (g_watch) tell(*g_watch);
  }
  errno = cause;
  return result;
}

int open_and_tell(int dirfd, const char* path, int flags, mode_t mode) {
  const long fd = ::syscall(SYS_openat, dirfd, path, flags, mode);
  return static_cast<int>(told(fd, [&](Watch& watch) {
    auto place = watch.find(dirfd, path);
    if (!place) return;
    if (place->node < 0) place->node = watch.make(*place, false);
    if ((flags & O_TRUNC) != 0) watch.size(place->node, 0);
    watch.open[static_cast<int>(fd)] = place->node;
  }));
}

template <typename Tell>
long told_of(int fd, long result, const Tell& tell) {
  return told(result, [&](Watch& watch) {
    if (const auto file = watch.open.find(fd); file != watch.open.end()) tell(watch, file->second);
  });
}

ssize_t written(int fd, const void* bytes, std::size_t count, off_t at) {
  const long done = ::syscall(SYS_pwrite64, fd, bytes, count, at);
  return told_of(fd, done, [&](Watch& watch, int file) {
    watch.write(file, static_cast<std::size_t>(at), bytes, static_cast<std::size_t>(done));
  });
}

int synced(int fd) {
  if (::fcntl(fd, F_GETFD) < 0) return -1;
  return static_cast<int>(told_of(fd, 0, [](Watch& watch, int file) {
    watch.log.changes.push_back({Kind::Sync, file});
  }));
}

int sized(int fd, off_t size) {
  return static_cast<int>(told_of(fd, ::syscall(SYS_ftruncate, fd, size), [&](Watch& watch, int file) {
    watch.size(file, static_cast<std::size_t>(size));
  }));
}

int renamed(int from_dir, const char* from, int to_dir, const char* to) {
  return static_cast<int>(told(::syscall(SYS_renameat2, from_dir, from, to_dir, to, 0U), [&](Watch& watch) {
    const auto old = watch.find(from_dir, from), next = watch.find(to_dir, to);
    if (old && next) watch.names({{old->folder, old->name, -1}, {next->folder, next->name, old->node}});
  }));
}

int removed(int dirfd, const char* path, int flags) {
  return static_cast<int>(told(::syscall(SYS_unlinkat, dirfd, path, flags), [&](Watch& watch) {
    if (const auto place = watch.find(dirfd, path)) watch.names({{place->folder, place->name, -1}});
  }));
}

int made_folder(int dirfd, const char* path, mode_t mode) {
  return static_cast<int>(told(::syscall(SYS_mkdirat, dirfd, path, mode), [&](Watch& watch) {
    if (const auto place = watch.find(dirfd, path)) watch.make(*place, true);
  }));
}

}  // namespace

WatchedDisk::WatchedDisk(const fs::path& root) {
  auto watch = std::make_unique<Watch>(fs::canonical(root));  // calls what it watches, too
  const std::lock_guard lock(g_mutex);
  g_watch = std::move(watch);
}
WatchedDisk::~WatchedDisk() {
  const std::lock_guard lock(g_mutex);
  g_watch.reset();
}
void WatchedDisk::acknowledge(std::size_t number) {
  const std::lock_guard lock(g_mutex);
  g_watch->log.changes.push_back({Kind::Acknowledged, -1, number});
}
const DiskLog& WatchedDisk::log() const { return g_watch->log; }

std::string WatchedDisk::unseen() const {
  for (const auto& entry : fs::recursive_directory_iterator(g_watch->root)) {
    // SQLite's index of its log is mapped, and made anew from the log.
    if (entry.is_directory() || entry.path().native().ends_with("-shm")) continue;
    const auto place = g_watch->find(AT_FDCWD, entry.path().c_str());
    if (!place || place->node < 0 || g_watch->node(place->node).bytes != read_text(entry.path()))
      return entry.path().filename().string();
  }
  return "";
}

}  // namespace relievo::test

using namespace relievo::test;  // the calls below are nobody's namespace

extern "C" {

#define RELIEVO_MODE                               \
  mode_t mode = 0;                                 \
  if ((flags & (O_CREAT | O_TMPFILE)) != 0) {      \
    va_list rest;                                  \
    va_start(rest, flags);                         \
    mode = static_cast<mode_t>(va_arg(rest, int)); \
    va_end(rest);                                  \
  }

int open(const char* path, int flags, ...) {
  RELIEVO_MODE
  return open_and_tell(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  RELIEVO_MODE
  return open_and_tell(AT_FDCWD, path, flags, mode);
}
int openat(int dirfd, const char* path, int flags, ...) {
  RELIEVO_MODE
  return open_and_tell(dirfd, path, flags, mode);
}
int openat64(int dirfd, const char* path, int flags, ...) {
  RELIEVO_MODE
  return open_and_tell(dirfd, path, flags, mode);
}
#undef RELIEVO_MODE

int mkostemp(char* path, int flags) {
  const std::string pattern = path;
  for (unsigned number = 0;; ++number) {
    const std::string ending = std::to_string(100'000 + number);
    std::copy(ending.begin(), ending.end(), path + pattern.size() - ending.size());
    const int fd = open_and_tell(AT_FDCWD, path, flags | O_RDWR | O_CREAT | O_EXCL, 0600);
    if (fd >= 0 || errno != EEXIST) return fd;
  }
}

int close(int fd) {
  return static_cast<int>(told(::syscall(SYS_close, fd), [&](Watch& watch) { watch.open.erase(fd); }));
}

ssize_t write(int fd, const void* bytes, std::size_t count) {
  const long done = ::syscall(SYS_write, fd, bytes, count);
  return told_of(fd, done, [&](Watch& watch, int file) {
    const long end = ::syscall(SYS_lseek, fd, 0, SEEK_CUR);
    watch.write(file, static_cast<std::size_t>(end - done), bytes, static_cast<std::size_t>(done));
  });
}
ssize_t pwrite(int fd, const void* bytes, std::size_t count, off_t at) {
  return written(fd, bytes, count, at);
}
ssize_t pwrite64(int fd, const void* bytes, std::size_t count, off_t at) {
  return written(fd, bytes, count, at);
}
int ftruncate(int fd, off_t size) noexcept { return sized(fd, size); }
int ftruncate64(int fd, off_t size) noexcept { return sized(fd, size); }
int posix_fallocate(int fd, off_t at, off_t count) {
  const long done = told_of(fd, ::syscall(SYS_fallocate, fd, 0, at, count), [&](Watch& watch, int file) {
    const auto end = static_cast<std::size_t>(at + count);
    if (watch.node(file).bytes.size() < end) watch.size(file, end);
  });
  return done == 0 ? 0 : errno;
}

int fsync(int fd) { return on_device() ? static_cast<int>(::syscall(SYS_fsync, fd)) : synced(fd); }
int fdatasync(int fd) { return on_device() ? static_cast<int>(::syscall(SYS_fdatasync, fd)) : synced(fd); }
int syncfs(int fd) noexcept {
  if (on_device()) return static_cast<int>(::syscall(SYS_syncfs, fd));
  return static_cast<int>(told(0, [](Watch& watch) { watch.log.changes.push_back({Kind::SyncAll}); }));
}

int rename(const char* from, const char* to) noexcept { return renamed(AT_FDCWD, from, AT_FDCWD, to); }
int renameat(int from_dir, const char* from, int to_dir, const char* to) noexcept {
  return renamed(from_dir, from, to_dir, to);
}
int unlink(const char* path) noexcept { return removed(AT_FDCWD, path, 0); }
int unlinkat(int dirfd, const char* path, int flags) noexcept { return removed(dirfd, path, flags); }
int rmdir(const char* path) noexcept { return removed(AT_FDCWD, path, AT_REMOVEDIR); }
int remove(const char* path) noexcept {
  const int gone = removed(AT_FDCWD, path, 0);
  return gone == 0 || errno != EISDIR ? gone : removed(AT_FDCWD, path, AT_REMOVEDIR);
}
int mkdir(const char* path, mode_t mode) noexcept { return made_folder(AT_FDCWD, path, mode); }
int mkdirat(int dirfd, const char* path, mode_t mode) noexcept { return made_folder(dirfd, path, mode); }

}  // extern "C"
