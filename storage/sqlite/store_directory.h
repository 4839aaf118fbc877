// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The directory of a store: who may see it, who may write it, and the room set aside in it.
// Errors: Timeout (another program holds it), InvalidInput (no directory), MediaFull, IoFailed.
// Thread: any.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>

#include "hal/base/result.h"

namespace relievo::storage {

// Held until destroyed; the system lets go of a dead process's.
class StoreLock {
 public:
  StoreLock() = default;
  ~StoreLock();
  StoreLock& operator=(StoreLock&&) = delete;

  Result<void> take(const std::filesystem::path& file, std::chrono::milliseconds wait);

 private:
  int fd_ = -1;
};

// 0700 where it is made here. One that is there already keeps its mode: it may hold other things.
Result<void> make_store_directory(const std::filesystem::path& dir);

// The store's directory by its true path: no link may stand in for the file; links on the way to it are the
// caller's business. IoFailed: this user may not look for it.
Result<std::filesystem::path> home_of(const std::filesystem::path& dir);

// The file of a store that is not to be made. NotFound: it is not there; IoFailed: this user may not look.
Result<void> must_be_there(const std::filesystem::path& file);

// SQLite needs its index beside a store that is only read, too. IoFailed: the directory takes none.
Result<void> must_take_files(const std::filesystem::path& dir);

// Makes the file if there is none; 0600 in any case. SQLite would go by the umask; its log and index
// take over the file's mode.
Result<void> make_private_file(const std::filesystem::path& file);

// As much of `bytes` as there is room for, unless it is there. Never an error, nor an exception: it is a
// precaution.
void set_aside_reserve(const std::filesystem::path& dir, std::int64_t bytes) noexcept;
bool give_up_reserve(const std::filesystem::path& dir);  // false: there was none

}  // namespace relievo::storage
