// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The folder in which a store lies, as whoever writes other files must know it: those could take the place of
// its files, or lie readable among them. Thread: any.
#pragma once

#include <filesystem>
#include <system_error>

#include "hal/base/result.h"

namespace relievo::storage {

inline constexpr const char *kStoreFile = "relievo.db", *kKeyFile = "relievo.key",
                            *kLockFile = "relievo.lock";  // in the store's directory

// A store that was opened for writing lies in it, or a store's key.
inline bool is_store_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / kLockFile, ignored) ||
         std::filesystem::exists(folder / kKeyFile, ignored);
}

// InvalidInput: the folder of this file is one.
inline Result<void> must_lie_outside_stores(const std::filesystem::path& file) {
  if (!is_store_folder(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."))) return {};
  return invalid("lies among a store's own files: choose another folder").at(file.native());
}

}  // namespace relievo::storage
