// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file that is read as a whole, and one that is written whole or not there: beside its place, made durable,
// then renamed into it.
// Errors, each with the path and what to do: NotFound, InvalidInput (not a file, empty, too large), IoFailed,
// MediaFull (no room or over quota), OutOfMemory.
// Thread: any, one at a time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "hal/base/result.h"

namespace relievo {

Result<std::vector<std::byte>> read_whole_file(const std::filesystem::path& file, std::size_t limit_bytes);
// The same of a file that this program made: no link may stand in its place, and it may be empty, as a power
// cut leaves it.
Result<std::vector<std::byte>> read_own_file(const std::filesystem::path& file, std::size_t limit_bytes);
// What root makes or writes for another user stays that user's: the open file gets the owner of `place`.
// Never a file with a second name, which may be anybody's. For anybody but root nothing is done.
void give_to_owner_of(const std::filesystem::path& place, int fd);
// All that PendingFile does at once. Only a device (/dev/full, /dev/stdout) is written in place, since a
// rename would replace it. `before`: what must have been done when the file gets its name; done when all its
// bytes are on the disk. Where that fails there is no file. `mode` as open(2) takes it.
Result<void> write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes,
                              const std::function<Result<void>()>& before = {}, unsigned mode = 0666);

class PendingFile {
 public:
  // Nothing that stands at `target` is touched before publish(). `mode` as open(2) takes it.
  static Result<PendingFile> create(const std::filesystem::path& target, unsigned mode = 0666);
  ~PendingFile();  // an unpublished file is removed
  PendingFile(PendingFile&& other) noexcept
      : target_(std::move(other.target_)),
        temporary_(std::move(other.temporary_)),
        fd_(std::exchange(other.fd_, -1)) {
    other.temporary_.clear();
  }
  PendingFile& operator=(PendingFile&&) = delete;

  void give_to_owner_of(const std::filesystem::path& place) { relievo::give_to_owner_of(place, fd_); }
  Result<void> write(std::span<const std::byte> bytes);
  Result<void> finish();   // no more bytes: all of them reach the disk
  Result<void> publish();  // after finish()

  const std::filesystem::path& target() const { return target_; }
  // Where its bytes are until publish().
  const std::filesystem::path& temporary() const { return temporary_; }

 private:
  PendingFile(std::filesystem::path target, std::filesystem::path temporary, int fd)
      : target_(std::move(target)), temporary_(std::move(temporary)), fd_(fd) {}
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int fd_ = -1;
};

// Names are durable only when their directory is.
Result<void> sync_directory(const std::filesystem::path& dir);
// A file or folder that was renamed to `target`. FAT writes a new name without the place where the file
// begins; that follows with the file itself, so this is synced first: else a cut leaves a name that leads
// nowhere.
Result<void> sync_renamed(const std::filesystem::path& target);

}  // namespace relievo
