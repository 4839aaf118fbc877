// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The folder in which a store lies, as whoever writes other files must know it: those could take the place of
// its files, or lie readable among them. Thread: any.
#pragma once

#include <filesystem>

#include "hal/base/result.h"

namespace relievo::storage {

inline constexpr const char *kStoreFile = "relievo.db", *kKeyFile = "relievo.key",
                            *kLockFile = "relievo.lock";  // in the store's directory

// A store that was opened for writing lies in it, or a store's key.
bool is_store_folder(const std::filesystem::path& folder);

// InvalidInput: the folder of this file is one.
Result<void> must_lie_outside_stores(const std::filesystem::path& file);

}  // namespace relievo::storage
