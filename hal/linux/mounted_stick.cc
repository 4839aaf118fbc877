// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "hal/linux/mounted_stick.h"

#include <fcntl.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "hal/base/words.h"

namespace relievo::hal {
namespace {

constexpr std::size_t kMostFolders = 16;  // looked at on every tick

class RealMounts final : public Mounts {
 public:
  // A folder on another device than its parent is where something is mounted.
  bool is_mounted(const std::filesystem::path& folder) override {
    struct stat own {
    }, above{};
    struct statvfs answer {};
    return ::lstat(folder.c_str(), &own) == 0 && S_ISDIR(own.st_mode) &&
           ::stat((folder / "..").c_str(), &above) == 0 && own.st_dev != above.st_dev &&
           ::statvfs(folder.c_str(), &answer) == 0;
  }
  int flush(const std::filesystem::path& folder) override {
    const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return -errno;
    const int result = ::syncfs(file) == 0 ? 0 : -errno;
    ::close(file);
    return result;
  }
  std::optional<MountSource> source_of(const std::filesystem::path& folder) override {
    std::ifstream in("/proc/self/mountinfo");
    const std::string table{std::istreambuf_iterator<char>(in), {}};
    return source_in(table, folder.native());
  }
  // The folder may have gone with the mount, as udisks does it.
  int mount_read_only(const MountSource& source, const std::filesystem::path& folder) override {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    return ::mount(source.device.c_str(), folder.c_str(), source.type.c_str(),
                   MS_RDONLY | MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr) == 0
               ? 0
               : -errno;
  }
  int unmount(const std::filesystem::path& folder) override {
    return ::umount2(folder.c_str(), UMOUNT_NOFOLLOW) == 0 ? 0 : -errno;
  }
};

constexpr Meaning kCannotUnmount[] = {
    {{EBUSY}, Errc::IoFailed, "something still uses the stick: wait a little and eject it again"},
    {{EPERM, EACCES},
     Errc::IoFailed,
     "everything is written, but this user may not unmount the stick: see hal/linux/README.md (installed: share/doc/relievo/board.md)"},
    {{EINVAL, ENOENT}, Errc::MediaMissing, "the stick is gone"},
    {{}, Errc::IoFailed, "the stick could not be unmounted; do not trust what was written"}};

// "\\040" is a blank: proc(5) writes blank, tab, line end and backslash in octal.
std::string unescaped(std::string_view text) {
  std::string plain;
  const auto octal = [](char c) { return c >= '0' && c <= '7'; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 3 < text.size() && octal(text[i + 1]) && octal(text[i + 2]) &&
        octal(text[i + 3])) {
      plain += char((text[i + 1] - '0') * 64 + (text[i + 2] - '0') * 8 + (text[i + 3] - '0'));
      i += 3;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

}  // namespace

std::optional<MountSource> source_in(std::string_view mountinfo, std::string_view folder) {
  std::optional<MountSource> found;
  std::istringstream lines{std::string(mountinfo)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string id, parent, device, root, at, word;
    if (!(words >> id >> parent >> device >> root >> at) || unescaped(at) != folder) continue;
    while (words >> word && word != "-") {
    }  // options, as many as there are
    std::string type, source;
    if (words >> type >> source) found = MountSource{unescaped(source), type};
  }
  return found;
}

Mounts& real_mounts() {
  static RealMounts mounts;
  return mounts;
}

std::optional<std::filesystem::path> MountedStick::find() const {
  if (mounts_.is_mounted(folder_)) return folder_;
  std::error_code failed;
  std::vector<std::filesystem::path> below;
  for (std::filesystem::directory_iterator entry(folder_, failed), end;
       !failed && entry != end && below.size() < kMostFolders; entry.increment(failed))
    below.push_back(entry->path());
  std::ranges::sort(below);
  for (const std::filesystem::path& path : below)
    if (mounts_.is_mounted(path)) return path;
  return std::nullopt;
}

std::optional<std::filesystem::path> MountedStick::current() {
  const std::lock_guard lock(mutex_);
  auto stick = find();
  if (stick != taken_up_) taken_up_.reset();
  return stick;
}

bool MountedStick::is_taken_up() {
  const std::lock_guard lock(mutex_);
  return taken_up_.has_value();
}

Result<void> MountedStick::flush_and_eject() {
  std::unique_lock lock(mutex_);
  const auto stick = find();
  if (!stick) return Error{Errc::MediaMissing, "there is no stick to eject"};
  lock.unlock();  // a slow stick must not hold who asks
  const int flushed = mounts_.flush(*stick);
  lock.lock();  // who looks into a stick keeps it from being unmounted
  if (flushed == -ENOENT || flushed == -ENODEV)
    return Error{Errc::MediaMissing, "the stick is gone", -flushed}.at(stick->native());
  if (flushed < 0)
    return Error{Errc::IoFailed, "the stick could not be flushed; do not trust what was written", -flushed}
        .at(stick->native());
  const auto source = mounts_.source_of(*stick);
  ejected_.reset();
  if (const int unmounted = mounts_.unmount(*stick); unmounted < 0)
    return meaning_of(-unmounted, kCannotUnmount).at(stick->native());
  taken_up_.reset();
  if (source) ejected_ = Ejected{*source, *stick};
  return {};
}

Result<void> MountedStick::take_up_again() {
  const std::lock_guard lock(mutex_);
  if (!ejected_) return Error{Errc::MediaMissing, "the stick is gone"};
  const Ejected again = *std::exchange(ejected_, std::nullopt);
  const int mounted = mounts_.mount_read_only(again.source, again.root);
  if (mounted == -ENOENT || mounted == -ENODEV || mounted == -ENXIO || mounted == -ENOMEDIUM)
    return Error{Errc::MediaMissing, "the stick is gone", -mounted}.at(again.root.native());
  if (mounted < 0)
    return Error{Errc::Unsupported, "the stick could not be mounted again: use another stick", -mounted}.at(
        again.root.native());
  taken_up_ = again.root;
  return {};
}

}  // namespace relievo::hal
